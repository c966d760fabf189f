"""``airlight`` command: subcommands, errors and exit status."""

from __future__ import annotations

import atexit
import contextlib
import gc
import keyword
import os
import re
import sys
import traceback
from collections.abc import Sequence
from importlib import import_module
from typing import Annotated, Any, Final

import typer
from typer.core import TyperCommand, TyperGroup

from airlight.child_processes import SAFE_PATH
from airlight.cli.console import examples, note, noted_warnings
from airlight.cli.interrupt import (
    INTERRUPTED,
    end_when_interrupted,
    leave,
    received,
    say_cancelled,
)
from airlight.cli.option_groups import expand_groups
from airlight.errors import AirlightError, Cancelled
from airlight.plain_text import brief

#: Exit status of an error.
ERROR = 2

#: Commands in the order of the help, each with its line of help: that of the function of this name
#: in the module of this name, which is not imported for it.
COMMANDS: Final = {
    "planets": "List the planets that ship with airlight.",
    "show": "Show a planet: parameters, optical depths, phase functions, sky colour; or a scene.",
    "import": "Write a planet file from a table: atmosphere, aerosol, profile, albedo or star.",
    "render": "Render a planet's atmosphere, or a scene of several bodies and lights.",
    "animate": "Render the missing or changed frames of a film.",
    "sky": "Write an observer's sky as an environment map, with a JSON file of its lights.",
    "compose": "Composite a planet's atmosphere over a rendered picture by its depth pass.",
    "aerial": "Bake aerial perspective around an observer to textures and shader functions.",
    "view": "Open an interactive viewer: fly, move the sun, edit parameters, probe radiances.",
    "radiance": "Compute spectral radiance along a line of sight, in W m⁻² sr⁻¹ nm⁻¹.",
    "irradiance": "Compute irradiance: GHI, DNI, DHI, illuminance, PAR, UV index; horizontal or "
    "tilted.",
    "spectrum": "Compute observables of a planet: albedos, phase curve, transit, limb, disc.",
    "sweep": "Compute the missing or changed blocks of a grid of radiances, in W m⁻² sr⁻¹ nm⁻¹.",
    "fit": "Fit parameters of a planet to measured radiances, or to a photograph of its sky.",
    "plot": "Plot a figure of a planet: star, atmosphere, radiation or tables.",
    "bake": "Bake a planet's radiation to look-up tables: NPZ, EXR and a JSON manifest.",
    "export-page": "Write an interactive page of a planet or a scene: one HTML file, below 5 MB.",
    "validate": "Check airlight against published numbers, independent codes and measured skies.",
}


#: Words of a registry, or help, choices and default of a declared field, in a help text or a
#: metavar: ``{module:NAME}``.
_REGISTRY: Final = re.compile(r"\{([\w.]+):(\w+)\}")


def with_words(text: str, between: str = ", ") -> str:
    """Help text with the names from registries and the help of fields, imported on demand."""

    def words(match: re.Match[str]) -> str:
        named = getattr(import_module(f"airlight.{match[1]}"), match[2])
        if not hasattr(named, "help"):
            return between.join(named)
        choices, default = named.choices(), named.initial
        listed = f": {between.join(choices)}" if choices else ""
        shown = f"{default:g}" if isinstance(default, float) else default
        return f"{named.help.rstrip('.')}{listed}" + (f" ({shown})" if shown is not None else "")

    return _REGISTRY.sub(words, text)


def word_of(command: str) -> str:
    """Name of the module and the function of a command.

    Examples
    --------
    >>> word_of("export-page"), word_of("import")
    ('export_page', 'import_')
    """
    return command.replace("-", "_") + "_" * keyword.iskeyword(command)


class Command(TyperCommand):
    """Command whose help lists the names from registries."""

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the options; registries are imported here."""
        for parameter in self.params:
            for name, between in (("help", ", "), ("metavar", "|")):
                text = getattr(parameter, name, None)
                if text:
                    setattr(parameter, name, with_words(text, between))
        super().format_options(ctx, formatter)


class Commands(TyperGroup):
    """Group of lazily imported commands."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Names of the commands, in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Command by name, or None."""
        if cmd_name not in COMMANDS:
            return None
        name = word_of(cmd_name)
        module = import_module(f"airlight.cli.{name}")
        alone = typer.Typer(**_TYPER)
        command = expand_groups(getattr(module, name))
        alone.command(cmd_name, cls=Command, epilog=module.EPILOG)(command)
        return typer.main.get_command(alone)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the list of commands."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


#: Plain-text help without markup: drawing boxes takes rich a tenth of a second.
_TYPER: Final[dict[str, Any]] = {
    "add_completion": False,
    "pretty_exceptions_enable": False,
    "rich_markup_mode": None,
    "context_settings": {"help_option_names": ["-h", "--help"]},
}
app = typer.Typer(
    **_TYPER,
    name="airlight",
    cls=Commands,
    epilog=examples(
        "airlight planets",
        "airlight render earth -o earth.png",
        "airlight radiance earth --altitude 0m --sun-zenith 60 --view-zenith 30 --azimuth 90",
    ),
)


def _print_version(asked: bool) -> None:
    if asked:
        from airlight.cli.version import version_line

        print(version_line())
        raise typer.Exit


@app.callback()
def root(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
    debug: Annotated[
        bool,
        typer.Option(
            "--debug", help="Show the traceback of an error; allowed anywhere on the command line."
        ),
    ] = False,
) -> None:
    """The light of planetary atmospheres: pictures, radiances, figures and tables."""


def run_process() -> int:
    """Run the command line as the main program; returns the exit status.

    Less garbage collection during imports, and none at exit, saves 0.3 to 0.5 s of a picture's 2.2
    s.
    """
    gc.set_threshold(100_000, 50, 50)
    atexit.register(gc.freeze)
    os.environ.update(SAFE_PATH)  # for what libraries start too
    end_when_interrupted()
    status = main()
    if status == INTERRUPTED:  # libraries would print errors about missing output at exit
        leave(status)
    return status


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Arguments after ``airlight``; default: those of the process.

    Returns
    -------
    int
        Exit status: 0, 2 after an error (one line on the standard error stream), 130 if
        interrupted.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    debug = "--debug" in words
    words = [word for word in words if word != "--debug"] or ["--help"]
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(AttributeError, ValueError):
            stream.reconfigure(errors="replace")  # type: ignore[union-attr]
    try:
        with noted_warnings():
            status = app(words, prog_name="airlight", standalone_mode=False)
        sys.stdout.flush()
    except (KeyboardInterrupt, Cancelled, typer.Abort):
        status = INTERRUPTED
    except BrokenPipeError:  # the reader of the output has closed it: not an error
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except Exception as error:
        status = _interrupted_status(error)
        if status is None:
            if debug:
                traceback.print_exc()
            note(_one_line(error))
            return ERROR
    if status == INTERRUPTED:
        say_cancelled()
    return status if isinstance(status, int) else 0


def _interrupted_status(error: BaseException | None) -> Any:
    """Exit status of an interruption that a library wrapped in an error or swallowed."""
    while error is not None and not isinstance(error, (KeyboardInterrupt, SystemExit)):
        error = error.__cause__ or error.__context__
    if error is None:
        return received[-1] if received else None
    return error.code if isinstance(error, SystemExit) else INTERRUPTED


def _one_line(error: Exception) -> str:
    worded: Any = getattr(error, "format_message", None)  # the parser's own errors
    if worded is not None:
        text = str(worded()).replace("Value error, ", "")
    elif isinstance(error, AirlightError):
        text = str(error).replace("allow overwriting", "add --overwrite")
    elif isinstance(error, MemoryError):
        text = f"not enough memory: {error}".rstrip(": ")
    elif isinstance(error, OSError) and error.filename is not None:
        text = f"{error.filename}: {error.strerror}"
    else:
        text = f"internal error, {type(error).__name__}: {error} (--debug shows where)"
    return brief(" ".join(text.split()))
