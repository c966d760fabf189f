"""MP4 encoding of a film by ffmpeg."""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Sequence
from importlib import util
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError, FileError
from airlight.files.atomic_file import atomic_file, check_target

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress

#: Rate factor and options of x264 with which row means of a smooth sky stay within 1.5 of 255, and
#: colour tags, two of which ffmpeg's own options omit.
_OUTPUT: Final = {
    "-crf": "12",
    "-preset": "medium",
    "-x264-params": (
        "aq-mode=3:deblock=-1,-1:colorprim=bt709:transfer=iec61966-2-1:colormatrix=bt709"
    ),
    "-vf": "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bicubic",
    "-movflags": "+faststart",
    "-f": "mp4",
}


def check_movie(path: Path, field: str) -> None:
    """Raise if a movie cannot be written.

    Parameters
    ----------
    path : Path
        Path of the MP4.
    field : str
        Name of the option, for error messages.
    """
    check_target(path)
    if util.find_spec("imageio_ffmpeg") is None:
        raise ConflictError(field, "requires imageio-ffmpeg for an MP4: pip install airlight[film]")


def write_movie(
    path: Path, frames: Sequence[Path], rate: float, progress: Progress | None = None
) -> None:
    """Encode PNG frames as MP4: H.264, 4:2:0, 8 bits, BT.709.

    Parameters
    ----------
    path : Path
        Path of the file, which is written atomically.
    frames : sequence of Path
        PNG frames of equal size, 8 bits, sRGB, in order. An odd last row or column is cropped, as
        4:2:0 requires even sizes.
    rate : float
        Frames per second. [1/s]
    """
    import imageio_ffmpeg

    height, width = (side - side % 2 for side in _pixels(frames[0]).shape[:2])
    if min(width, height) < 2:
        raise FileError(path, "cannot be written: frames have less than two pixels a side")
    with atomic_file(path) as part:
        writer = imageio_ffmpeg.write_frames(
            str(part),
            (width, height),
            fps=rate,
            codec="libx264",
            macro_block_size=2,
            quality=None,
            pix_fmt_in="rgb24",
            pix_fmt_out="yuv420p",
            ffmpeg_log_level="quiet",
            output_params=[word for option in _OUTPUT.items() for word in option],
        )
        try:
            writer.send(None)
            for number, file in enumerate(frames):
                pixels = _pixels(file)[:height, :width]
                with contextlib.suppress(OSError):  # ffmpeg has ended: its file says how far
                    writer.send(np.ascontiguousarray(pixels).tobytes())
                if progress is not None:
                    progress(number + 1, len(frames), "film")
        finally:
            writer.close()
        written = _frame_count(part)
        if written != len(frames):
            free = shutil.disk_usage(part.parent).free
            reason = (
                f"cannot be written: ffmpeg has written {written} of {len(frames)} frames; "
                f"the disk has {free / 1e6:.0f} MB free; the frames remain"
            )
            raise FileError(path, reason)


def _pixels(file: Path) -> NDArray[np.uint8]:
    from PIL import Image

    try:
        with Image.open(file) as picture:
            return np.asarray(picture.convert("RGB"))
    except (OSError, ValueError, SyntaxError) as error:
        raise FileError(file, f"cannot be read as a picture: {error}") from error


def _frame_count(file: Path) -> int:
    """Number of readable frames, as ffmpeg does not report incomplete output."""
    import imageio_ffmpeg

    try:
        return int(imageio_ffmpeg.count_frames_and_secs(str(file))[0])
    except (RuntimeError, OSError):
        return 0
