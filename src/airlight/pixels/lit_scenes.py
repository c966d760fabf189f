"""Pictures that sum to a scene's: one for each of its lights."""

from __future__ import annotations

from airlight.scene import Scene
from airlight.solvers.moments.solution import MomentsSolution


def lit_scenes(scene: Scene, solution: MomentsSolution) -> list[tuple[Scene, MomentsSolution]]:
    """Scene and solution of each light alone.

    Light adds up, so a picture is the sum of those of its lights: each has the light at the sun's
    place, with its own irradiance, spectrum and disc. No light costs another solve.

    Parameters
    ----------
    scene : Scene
        Observer, lights and camera.
    solution : MomentsSolution
        Solution of the planet.

    Returns
    -------
    list of (Scene, MomentsSolution)
        Pairs with one light each, in the order of ``scene.lights``.
    """
    sources = solution.lights
    pairs = []
    for light in scene.lights:
        source = light.source(sources)
        lit = solution if source is sources[0] else solution.lit_by(source)
        pairs.append((scene.lit_by(light), lit))
    return pairs
