"""The command line: the command `viscorough`, with a module for each of its subcommands.

For a user's mistake the command line writes one line on stderr, "viscorough COMMAND: the error, its place, the allowed
values", returns exit code 2, and leaves no output file. Exit code 1 means that a solver did not converge, 3 that a
table of several files is complete but some of them failed, and 0 that the output file is complete, also if the closing
line could not be written to stdout. If warnings are errors (PYTHONWARNINGS=error), a warning is treated like a mistake.
Modules that take long to import are imported only by the commands that need them, so help and messages come quickly.
"""

import os
import sys
import warnings
from importlib import import_module
from signal import SIG_DFL

import click
from click.shell_completion import shell_complete

from viscorough.basics.argument_names import spelled_as_options
from viscorough.basics.errors import ConvergenceError
from viscorough.basics.interrupts import on_interrupt
from viscorough.cli import messages

# Environment variable, named by click, with which the shell asks for completions.
_COMPLETE = "_VISCOROUGH_COMPLETE"


@click.group(
    invoke_without_command=True, context_settings={"show_default": True, "help_option_names": ["-h", "--help"]}
)
@click.version_option(package_name="viscorough", message="%(prog)s %(version)s")
@click.pass_context
def cli(context: click.Context) -> None:
    """Penetration of rough rigid indenters into a linearly viscous half-space.

    \b
    Example: a map of heights in metres, points 2 micrometres apart, pressed by 5 N into 1e6 Pa s:
        viscorough indent heights.npy --spacing 2e-6 -o curve.nc
        viscorough kinetics curve.nc --force 5 --viscosity 1e6 -o kinetics.nc

    \b
    Completion of commands, options and files by the tab key, in bash (in zsh: zsh_source):
        eval "$(_VISCOROUGH_COMPLETE=bash_source viscorough)"
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


for _name in ("indent", "contact", "kinetics", "creep", "march", "reduce", "generate", "estimate", "plot"):
    cli.add_command(getattr(import_module(f"{__name__}.{_name}"), _name))


def main(arguments: list[str] | None = None, commands: click.Group = cli) -> int:
    """Run the command line and return its exit code.

    arguments : list of texts; default: those of the process
    commands : the click.Group to run
    """
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    if instruction := os.environ.get(_COMPLETE):
        return shell_complete(commands, {}, "viscorough", _COMPLETE, instruction)
    command = " ".join(["viscorough", *(name for name in arguments[:1] if name in commands.commands)])
    messages.escape_unencodable_characters()
    try:
        with (
            on_interrupt(SIG_DFL),  # ends the process at once, also where libraries do not return to Python
            warnings.catch_warnings(record=True) as caught,
            spelled_as_options(),
            commands.make_context("viscorough", arguments, obj=caught) as context,
        ):
            commands.invoke(context)
        for text in messages.warning_texts(caught):
            messages.complain(command, f"warning: {text}")
    except click.exceptions.Exit as done:
        return done.exit_code
    except BrokenPipeError:  # the reader of standard output has ended, such as head in viscorough --help | head
        return 0
    except KeyboardInterrupt:
        return 130
    except ConvergenceError as error:
        messages.report(command, error)
        return 1
    except messages.ERRORS as error:
        messages.report(command, error)
        return 2
    finally:
        messages.discard_what_cannot_be_written()
    return 0
