"""Free memory of this machine, checked before large computations, and its release."""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path
from typing import Final

from airlight.errors import CostError, FileError
from airlight.kernel.large_arrays import LARGE, free_disk

#: Largest picture that is decoded. [pixel]
MOST_PIXELS: Final = 200_000_000
#: Memory of a pixel from radiance to file, measured at 2560 x 1440. [byte]
_DRAWN: Final = 32
#: The same if radiance, glare and colours are stored in files: 3.3 measured at 8192 x 8192, with a
#: safety factor of 2; and size of these files: 12 of radiance, 12 of a second one, 6 of glare, up
#: to 6 of colours. [byte]
_FILED_DRAWN: Final = 7
_ON_DISK: Final = 36
#: Memory of a pixel's radiance. [byte]
_LIGHT: Final = 12
#: Memory of a decoded pixel: Pillow's own and the array's, with eight bits per channel. [byte]
DECODED: Final = 8
#: Options of ``mallopt``: ``M_ARENA_MAX`` and ``M_MMAP_THRESHOLD`` of malloc.h; and the size from
#: which memory is the system's again once it is freed. [byte]
_MOST_HEAPS: Final = -8
_LEAST_OWN: Final = -3
_OWN: Final = 1 << 20
#: Files of the Linux kernel with the free memory and the limits of a container.
_MEMINFO: Final = Path("/proc/meminfo")
_GROUP: Final = Path("/sys/fs/cgroup")


def free_memory() -> float:
    """Memory available to this process; infinite if unknown. [byte]

    The least of the machine's free memory and the limits of container and process.
    """
    free = [_of_machine(), _of_container(), _of_process()]
    return min(free)


def give_back() -> None:
    """Return unused memory of the C library to the system."""
    if sys.platform == "linux":
        trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # glibc's
        if trim is not None:
            trim(0)


def share_memory_of_threads() -> None:
    """Let the C library serve all threads from two heaps, so that they reuse each other's memory.

    By default each thread has its own, whose gaps count as used: 90 to 170 MB in the window; and
    arrays of up to 32 MB are in them, whose gaps took 700 MB after Jupiter was solved.
    """
    if sys.platform == "linux":
        option = getattr(ctypes.CDLL(None), "mallopt", None)  # glibc's
        if option is not None:
            option(_MOST_HEAPS, 2)
            option(_LEAST_OWN, _OWN)


def check_memory(needed: float, work: str) -> None:
    """Raise an error if a computation needs more memory than is free.

    Parameters
    ----------
    needed : float
        Estimate of the memory. [byte]
    work : str
        Subject of the error: ``"a picture of 20000x10000 pixels"``.

    Examples
    --------
    >>> check_memory(1e6, "a small picture")
    >>> try:
    ...     check_memory(1e18, "a picture of 300000000x300000000 pixels")
    ... except CostError as error:
    ...     print(str(error).partition(";")[0])
    a picture of 300000000x300000000 pixels needs about 1e+09 GB of memory
    """
    free = free_memory()
    if needed > free:
        raise CostError(
            f"{work} needs about {needed / 1e9:.2g} GB of memory; {free / 1e9:.2g} GB are free"
        )


def check_drawn(width: int, height: int, layers: int = 1) -> None:
    """Raise an error if a picture to be rendered does not fit into memory.

    Large pictures use the disk, see ``kernel.large_arrays``.

    Parameters
    ----------
    width, height : int
        Size. [pixel]
    """
    pixels = float(width) * height * layers
    needed = _DRAWN * pixels
    filed = _LIGHT * pixels >= LARGE and free_disk() >= _ON_DISK * pixels
    # The process limit includes mapped files.
    if filed and _of_process() >= _ON_DISK * pixels:
        needed = _FILED_DRAWN * pixels
    check_memory(needed, f"a picture of {width}x{height} pixels")


def check_picture(file: str | Path, width: int, height: int, each: int = DECODED) -> None:
    """Raise an error if a picture is too large by the size in its header.

    Parameters
    ----------
    file : str or Path
        Subject of the error.
    each : int
        Memory of a pixel while it is decoded. [byte]

    Raises
    ------
    FileError
        If it has more than 200 million pixels.

    Examples
    --------
    >>> check_picture("dome.exr", 100_000, 50_000)
    Traceback (most recent call last):
    ...
    airlight.errors.FileError: dome.exr: has 100000 x 50000 pixels; allowed: 200000000 in all
    """
    if width * height > MOST_PIXELS:
        raise FileError(file, f"has {width} x {height} pixels; allowed: {MOST_PIXELS} in all")
    check_memory(float(each) * width * height, f"{file}, a picture of {width}x{height} pixels,")


def _of_machine() -> float:
    try:
        text = _MEMINFO.read_text(encoding="ascii")
        return 1024.0 * float(text.split("MemAvailable:")[1].split()[0])
    except (OSError, ValueError, IndexError):
        return _physical()


def _physical() -> float:
    try:
        return float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    except (AttributeError, OSError, ValueError):
        return float("inf")


def _of_container() -> float:
    """Memory available to the container, its page cache included. [byte]"""
    try:
        most = float((_GROUP / "memory.max").read_text(encoding="ascii"))
        taken = float((_GROUP / "memory.current").read_text(encoding="ascii"))
        words = (_GROUP / "memory.stat").read_text(encoding="ascii").split()
        uses = dict(zip(words[::2], map(float, words[1::2]), strict=True))
        return most - taken + uses["active_file"] + uses["inactive_file"]
    except (OSError, ValueError, KeyError):  # "max", or no container
        return float("inf")


def _of_process() -> float:
    try:
        import resource

        most = resource.getrlimit(resource.RLIMIT_AS)[0]
        if most == resource.RLIM_INFINITY:
            return float("inf")
        pages = float(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
        return most - pages * os.sysconf("SC_PAGE_SIZE")
    except (ImportError, OSError, ValueError, IndexError):
        return float("inf")
