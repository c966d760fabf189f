"""What costs more than the machine has is refused before it is begun."""

from __future__ import annotations

import re
import struct
import subprocess
import sys
import time
import zlib
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet, solve
from airlight.engines.composition.render_passes import read_render_passes
from airlight.errors import CostError, FileError
from airlight.image.exr import read_exr, read_exr_channels, write_exr
from airlight.kernel import cost, memory
from airlight.kernel.cost import announce
from airlight.physics.optics import mie
from airlight.planets.map_picture import map_pixels
from airlight.planets.matter.mie_nodes import mie_nodes
from airlight.planets.matter.particle_index import GivenIndex
from airlight.planets.matter.particle_sizes import GammaSizes
from airlight.render import render
from airlight.scene import Camera, Scene
from airlight.studies.film import Finish, Quality, animate, load_film
from airlight.studies.film.frame_spec import PlanetFrameSpec
from airlight.studies.fit.photograph import Shot, read_photograph
from airlight.studies.sweep import Grid, rows
from airlight.studies.sweep.shared_solution import RadianceTask

#: The module, whose function has its name.
sweep_module = import_module("airlight.studies.sweep.sweep")


@pytest.fixture
def small_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine with 100 MB of free memory."""
    monkeypatch.setattr(memory, "free_memory", lambda: 1e8)


@pytest.mark.skipif(sys.platform != "linux", reason="reads what Linux says")
def test_free_memory_is_what_the_system_says() -> None:
    total = 1024.0 * float(Path("/proc/meminfo").read_text().split("MemTotal:")[1].split()[0])
    assert 0.0 < memory.free_memory() <= total


@pytest.mark.skipif(sys.platform != "linux", reason="reads what Linux says")
def test_a_limit_of_the_process_counts() -> None:
    script = (
        "import resource; resource.setrlimit(resource.RLIMIT_AS, (3_000_000_000, 3_000_000_000))\n"
        "from airlight.kernel.memory import free_memory; print(free_memory())"
    )
    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert 0.0 < float(found.stdout) < 3e9


def test_a_container_s_cache_of_files_is_free(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # 100 MB allowed, 90 MB taken, 60 MB of them pages of files: 70 MB are left
    monkeypatch.setattr(memory, "_GROUP", tmp_path)
    (tmp_path / "memory.max").write_text("100000000\n")
    (tmp_path / "memory.current").write_text("90000000\n")
    (tmp_path / "memory.stat").write_text("active_file 20000000\ninactive_file 40000000\n")
    assert memory.free_memory() == 70e6
    (tmp_path / "memory.max").write_text("max\n")
    assert memory.free_memory() > 70e6


@pytest.mark.skipif(sys.platform != "linux", reason="an option of the C library of Linux")
def test_large_arrays_of_a_window_are_returned_when_they_are_freed() -> None:
    # Of 200 MB between small arrays that stay; by default they would stay in the heap.
    code = """if True:
        import numpy as np
        from pathlib import Path
        from airlight.kernel.memory import share_memory_of_threads
        share_memory_of_threads()
        for number in (2, 100):
            arrays = [(np.ones(1 << 18), np.ones(1 << 13)) for _ in range(number)]
            kept = [small for _, small in arrays]
            del arrays
        status = Path("/proc/self/status").read_text()
        print(status.split("RssAnon:")[1].split()[0])"""
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert float(done.stdout) < 1e5  # kB


def test_a_picture_beyond_the_memory_is_refused_at_once(small_machine: None) -> None:
    solution = solve("earth-openspace", [680, 550, 440], "preview")
    begun = time.perf_counter()
    with pytest.raises(CostError, match=r"a picture of 4000x2000 pixels needs about 0.26 GB"):
        render(solution, Scene(camera=Camera(width=4000, height=2000)))
    assert time.perf_counter() - begun < 1.0


def test_wavelengths_beyond_the_memory_are_refused_at_once(small_machine: None) -> None:
    planet = load_planet("earth-openspace")
    with pytest.raises(CostError, match=r"the light of 5000 wavelengths needs about .* GB"):
        solve(planet, np.linspace(400.0, 700.0, 5000), "fine")


def test_a_picture_is_refused_before_its_planet_is_solved(
    small_machine: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    from airlight.render import render_scene as painting

    def solved(*_: object, **__: object) -> None:
        raise AssertionError("solved")

    monkeypatch.setattr(painting, "solve_planet", solved)
    with pytest.raises(CostError, match=r"a picture of 4000x2000 pixels needs about 0.26 GB"):
        painting.render_scene(
            load_planet("earth-openspace"), Scene(camera=Camera(width=4000, height=2000))
        )


def test_large_particles_are_refused_at_once(small_machine: None) -> None:
    # 378 MB of angular functions a thread at a size parameter of 2885
    index = GivenIndex(real=1.33, imaginary=0.0)
    sizes = GammaSizes(effective_radius=7e-5, effective_variance=0.1)
    begun = time.perf_counter()
    with pytest.raises(
        CostError, match=r"light of particles of size parameter 28\d\d needs about .* GB"
    ):
        mie_nodes(index, sizes, [550.0])
    assert time.perf_counter() - begun < 5.0


def test_large_particles_are_announced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AIRLIGHT_CACHE", str(tmp_path))
    monkeypatch.setattr(
        mie, "scattering", lambda *_, **__: (_ for _ in ()).throw(KeyboardInterrupt)
    )
    lines: list[str] = []
    before = announce.set(lines.append)
    index = GivenIndex(real=1.33, imaginary=0.0)
    sizes = GammaSizes(effective_radius=5.5e-5, effective_variance=0.1)
    with pytest.raises(KeyboardInterrupt):
        mie_nodes(index, sizes, [440.0, 550.0, 680.0])
    announce.reset(before)
    (line,) = lines
    assert re.fullmatch(r"particles at 3 wavelengths: about \S+ (s|min)", line)


@pytest.fixture
def announced(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """Lines about long work, in which any time is long."""
    monkeypatch.setattr(cost, "LONG", 0.0)
    monkeypatch.setattr(cost, "_rates", lambda: cost.RATES)
    lines: list[str] = []
    before = announce.set(lines.append)
    yield lines
    announce.reset(before)


def never(*_: object, **__: object) -> None:
    raise KeyboardInterrupt


def seconds(line: str) -> float:
    """Time that a line says."""
    number, unit = line.split("about ")[1].split()
    return float(number) * {"s": 1.0, "min": 60.0, "h": 3600.0, "days": 86400.0}[unit]


def test_the_frames_of_a_film_are_announced_before_the_first(
    announced: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(PlanetFrameSpec, "prepare", never)
    monkeypatch.setattr(PlanetFrameSpec, "render", never)
    found, how = [], Quality(width=480, height=270)
    for frames, albedo in ((60, "0.1, 0.1"), (600, "0.1, 0.1"), (600, "0.1, 0.2")):
        keys = [{"path": "ground.albedo", "values": albedo}]
        film = load_film("earth-openspace", {"film.frames": frames, "film.keys": keys})
        with pytest.raises(KeyboardInterrupt):
            animate(film, tmp_path / "frames", how=how, finish=Finish(exposure=0.0), workers=1)
        assert announced[-1].startswith(f"{frames} frames of 480x270 pixels: about ")
        found.append(seconds(announced[-1]))
    # ten times the frames take ten times as long, and a solution for each of them much longer
    assert_allclose(found[1] / found[0], 10.0, rtol=0.1)
    assert found[2] > 3.0 * found[1]


def test_a_sweep_and_a_table_of_observers_are_announced_before_they_begin(
    announced: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    views = list(range(0, 80, 8))
    grid = Grid(planets=["earth-openspace"], vary={"ground.albedo": [0.1, 0.2, 0.3]},
                altitude=[0.0], sun_zenith=views, view_zenith=views, azimuth=[0.0])  # fmt: skip
    monkeypatch.setattr(sweep_module, "solved", never)
    with pytest.raises(KeyboardInterrupt):
        sweep_module.sweep(grid, tmp_path / "a.zarr", workers=1)
    assert announced[-1].startswith("3 solutions and 300 lines of sight: about ")
    monkeypatch.setattr(RadianceTask, "solution", lambda *_, **__: None)
    monkeypatch.setattr(rows, "radiances_of_lines", never)
    table = tmp_path / "in.csv"
    table.write_text(
        "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg\n" + "0,60,30,90\n" * 70
    )
    with pytest.raises(KeyboardInterrupt):
        task = RadianceTask(planet=grid.planet((0, 0)), wavelengths=(550.0,))
        rows.answer_rows(task, str(table), str(tmp_path / "out.csv"))
    assert announced[-1].startswith("70 lines of sight: about ")


def test_a_map_is_refused_by_its_header_where_the_memory_is_small(
    small_machine: None, tmp_path: Path
) -> None:
    with pytest.raises(CostError, match=r"a picture of 6000x3000 pixels, needs about 0.14 GB"):
        map_pixels(bomb(tmp_path / "bomb.png", 6000, 3000))


def bomb(path: Path, width: int, height: int) -> Path:
    """PNG whose header promises many pixels, with a few bytes behind it."""

    def chunk(kind: bytes, content: bytes) -> bytes:
        check = struct.pack(">I", zlib.crc32(kind + content))
        return struct.pack(">I", len(content)) + kind + content + check

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = zlib.compress(b"\0" * 1000)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data)
                     + chunk(b"IEND", b""))  # fmt: skip
    return path


@pytest.mark.parametrize("size", [(20_000, 10_001), (60_000, 30_000), (2**31 - 1, 2**30)])
def test_a_picture_s_header_is_read_before_its_pixels(
    size: tuple[int, int], tmp_path: Path
) -> None:
    file = bomb(tmp_path / "bomb.png", *size)
    for read in (map_pixels, lambda path: read_photograph(path, Shot(sun_zenith=60.0))):
        with pytest.raises(FileError, match="pixels") as caught:
            read(file)
        assert "\n" not in str(caught.value)


def test_an_exr_s_header_is_read_before_its_pixels(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "a.exr"
    rgb = np.full((4, 8, 3), 0.5, np.float32)
    write_exr(file, rgb)
    assert_allclose(read_exr(file)[0], rgb)
    monkeypatch.setattr(memory, "MOST_PIXELS", 31)
    for read in (read_exr, read_exr_channels, read_render_passes):
        with pytest.raises(FileError, match=r"has 8 x 4 pixels; allowed: 31 in all"):
            read(file)
