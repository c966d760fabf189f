"""MP4 of a film's frames, by ffmpeg."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import util
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.errors import FileError, ParameterError
from airlight.exports.whole_file import check_target, whole_file

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress

#: Rate factor and options of x264 by which means of rows of a smooth sky stay within 1.5 of 255,
#: and the tags of what the numbers mean: ffmpeg's own options leave two of them out.
_QUALITY: Final = 12
_OPTIONS: Final = "aq-mode=3:deblock=-1,-1:colorprim=bt709:transfer=iec61966-2-1:colormatrix=bt709"
_SCALE: Final = (
    "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bicubic"
)


def check_movie(path: Path, field: str) -> None:
    """Refuse, before frames are drawn, a film that could not be written.

    Parameters
    ----------
    path : Path
        Path of the future MP4.
    field : str
        Name in errors.

    Raises
    ------
    ParameterError
        If imageio-ffmpeg is not installed.
    FileError
        If nothing can be written there.
    """
    check_target(path)
    if util.find_spec("imageio_ffmpeg") is None:
        allowed = "a folder of frames without imageio-ffmpeg: pip install airlight[film]"
        raise ParameterError(field, str(path), allowed)


def write_movie(
    path: Path, frames: Sequence[Path], rate: float, progress: Progress | None = None
) -> None:
    """Write an MP4 of PNG frames: H.264, 4:2:0, eight bits, BT.709.

    Parameters
    ----------
    path : Path
        Path of the file, which appears whole or not at all.
    frames : sequence of Path
        PNG frames of one size, of eight bits, sRGB, in order. An odd last row or column is left
        out, which the format does not have.
    rate : float
        Frames per second. [1/s]
    progress : callable, optional
        See ``airlight.kernel.threads``.

    Raises
    ------
    FileError
        If a frame cannot be read, or ffmpeg fails.
    """
    import imageio_ffmpeg
    from PIL import Image

    with Image.open(frames[0]) as first:
        width, height = (side - side % 2 for side in first.size)
    if min(width, height) < 2:
        raise FileError(path, "cannot be written: frames have less than two pixels a side")
    with whole_file(path) as part:
        target = part.with_suffix(".mp4.part")
        writer = imageio_ffmpeg.write_frames(
            str(target), (width, height), fps=rate, codec="libx264", macro_block_size=2,
            quality=None, pix_fmt_in="rgb24", pix_fmt_out="yuv420p", ffmpeg_log_level="error",
            output_params=[
                "-crf", str(_QUALITY), "-preset", "medium", "-x264-params", _OPTIONS,
                "-vf", _SCALE, "-movflags", "+faststart", "-f", "mp4",
            ],
        )  # fmt: skip
        try:
            writer.send(None)
            for number, file in enumerate(frames):
                with Image.open(file) as picture:
                    pixels = np.asarray(picture.convert("RGB"))[:height, :width]
                writer.send(np.ascontiguousarray(pixels).tobytes())
                if progress is not None:
                    progress(number + 1, len(frames), "film")
            writer.close()
            target.replace(part)
        except OSError as error:
            raise FileError(path, f"cannot be written: {error}") from error
        finally:
            writer.close()
            target.unlink(missing_ok=True)
