"""Films of a picture under a moving sun, as animated WebP or PNG."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Final

from airlight.errors import Cancelled, FileError
from airlight.files.atomic_file import atomic_file
from airlight.image.exposure import eased
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.parameters import replace
from airlight.render.render_scene import render_solution
from airlight.scene import Scene
from airlight.scene.sun_time import sun_at, time_of
from airlight.viewer.painting.picture_source import Picture
from airlight.viewer.session.adaptation import TIME_CONSTANT

if TYPE_CHECKING:
    from PIL.Image import Image

#: Zenith angle and compass bearing of the sun. [deg]
Sun = tuple[float, float]
#: Frame rate. [s⁻¹]
RATE: Final = 20
#: Formats by the suffix of the file.
_FORMATS: Final = {".webp": "WEBP", ".png": "PNG"}
#: Largest total size of the frames, which the encoders hold in memory. [byte]
_LARGEST: Final = 1_500_000_000
#: Quality of lossy WebP, with which contours of a sky stay below a step of 8 bits.
_QUALITY: Final = 92


def film_format(path: str | Path) -> str:
    """Format of a film by the name of its file.

    Examples
    --------
    >>> film_format("sunset.webp")
    'WEBP'
    """
    suffix = Path(path).suffix.lower()
    if suffix not in _FORMATS:
        raise FileError(path, "the name of a film ends in .webp or .png")
    return _FORMATS[suffix]


def sun_path(latitude: float, sun: Sun, hours: float, seconds: float) -> tuple[Sun, ...]:
    """Directions of the sun in successive frames of a time lapse.

    Parameters
    ----------
    latitude : float
        Latitude of the observer. [deg]
    sun : (float, float)
        Direction in the first frame. [deg]
    hours : float
        Time lapse. [h]
    seconds : float
        Length of the film. [s]

    Examples
    --------
    >>> path = sun_path(0.0, (60.0, 90.0), 4.0, 1.0)
    >>> len(path), round(path[-1][0], 6)
    (20, 3.0)
    """
    declination, hour = time_of(latitude, *sun)
    count = max(2, round(RATE * seconds))
    return tuple(
        sun_at(latitude, declination, (hour + hours * index / count) % 24.0)
        for index in range(count)
    )


def sunlit(scene: Scene, suns: tuple[Sun, ...]) -> tuple[Scene, ...]:
    """Scenes with a fixed camera under other suns; azimuths are measured from the sun."""
    heading = scene.camera.look_azimuth + scene.sun_azimuth
    return tuple(
        replace(
            scene,
            sun_zenith=zenith,
            sun_azimuth=azimuth,
            camera=replace(scene.camera, look_azimuth=(heading - azimuth) % 360.0),
        )
        for zenith, azimuth in suns
    )


def write_film(
    path: str | Path,
    picture: Picture,
    scenes: tuple[Scene, ...],
    *,
    progress: Progress,
    cancel: Cancel,
) -> int:
    """Render scenes and write them as a film, atomically.

    Parameters
    ----------
    path : str or Path
        Path that ends in ``.webp`` or ``.png``.
    picture : Picture
        Picture whose solution, orders, display settings and exposure are used; automatic exposure
        starts there and adapts smoothly.
    scenes : tuple of Scene
        Scenes, one for each frame.

    Returns
    -------
    int
        Size of the file. [byte]

    Raises
    ------
    FileError
        If the file cannot be written, or its frames would need more than 1.5 GB.
    """
    form = film_format(path)
    camera = scenes[0].camera
    if 3 * camera.width * camera.height * len(scenes) > _LARGEST:
        raise FileError(path, "the film is too large; make it shorter or smaller")
    first, *rest = _frames(picture, scenes, progress, cancel)
    more = {"quality": _QUALITY, "method": 2} if form == "WEBP" else {}
    with atomic_file(path) as place:
        first.save(
            place, form, save_all=True, append_images=rest, duration=1000 // RATE, loop=0, **more
        )
    return Path(path).stat().st_size


def _frames(
    picture: Picture, scenes: tuple[Scene, ...], progress: Progress, cancel: Cancel
) -> Iterator[Image]:
    from PIL import Image

    request, exposure = picture.request, picture.exposure
    for index, scene in enumerate(scenes):
        if cancel():
            raise Cancelled("the film")
        frame = render_solution(request.solution, scene, orders=request.orders, cancel=cancel)
        if request.automatic and not request.held:
            exposure = eased(exposure, frame.exposure + request.exposure, 1.0 / RATE, TIME_CONSTANT)
        yield Image.fromarray(request.displayed(frame, exposure))
        progress(index + 1, len(scenes), "filming")
