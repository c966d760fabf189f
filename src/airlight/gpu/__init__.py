"""Pictures and solutions on the GPU, from the same formulas as on the CPU.

``gpu_renderer.GpuRenderer`` renders what ``airlight.render`` renders, of solutions of at most four
wavelengths::

    from airlight import Scene, load_planet, solve
    from airlight.color.four_wavelengths import four_wavelengths
    from airlight.gpu.device.device import open_device
    from airlight.gpu.picture.gpu_renderer import GpuRenderer

    planet = load_planet("earth")
    wavelengths, weights = four_wavelengths(planet.star.irradiances)
    pictures = GpuRenderer(open_device())
    pictures.set_solution(solve(planet, wavelengths), weights)
    frame = pictures.render(Scene(), exact=True)

``exact`` marches every pixel, as the CPU does; otherwise pixels read a sky-view LUT that is
rendered first, for pictures many times a second. ``open_device`` raises ``NoDevice``, which says in
one line what is missing.
"""
