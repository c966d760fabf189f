"""Solver and renderer on the GPU, emitted from the kernels of the CPU.

``gpu_renderer.GpuRenderer`` renders as ``airlight.render``, for solutions of at most four
wavelengths::

    from airlight import Scene, load_planet, solve
    from airlight.image.four_wavelengths import four_wavelengths
    from airlight.render.gpu.device.device import open_device
    from airlight.render.gpu.picture.gpu_renderer import GpuRenderer

    planet = load_planet("earth")
    wavelengths, weights = four_wavelengths(planet.star.irradiances)
    renderer = GpuRenderer(open_device())
    renderer.set_solution(solve(planet, wavelengths), weights)
    frame = renderer.render(Scene(), exact=True)

``exact`` marches every pixel; otherwise pixels are interpolated in a sky-view LUT, for interactive
frame rates. ``open_device`` raises ``NoDevice`` with the reason in one line.
"""
