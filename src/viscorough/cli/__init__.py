"""Define the command `viscorough`; each of its subcommands has a module in this package.

The exit codes are

- 0: the output file is complete, even if the closing line could not be written to standard output,
- 1: a solver did not converge,
- 2: the user made a mistake. Standard error then shows one line, "viscorough COMMAND: the error, its place, the allowed
  values", and no output file is left. A warning counts as a mistake if warnings are errors (PYTHONWARNINGS=error).

Modules that take long to import are imported only by the commands that need them, so help and messages come quickly.
"""

import os
import sys
import warnings

import click
from click.shell_completion import shell_complete

from viscorough.basics.errors import ConvergenceError
from viscorough.cli import (
    contact,
    estimate,
    generate,
    indent,
    kinetics,
    march,
    messages,
    options,
    plot,
    reduce,
)

# Name, fixed by click, of the environment variable that the shell sets when it asks for completions.
_COMPLETE = "_VISCOROUGH_COMPLETE"


@click.group(
    invoke_without_command=True, context_settings={"show_default": True, "help_option_names": ["-h", "--help"]}
)
@click.version_option(package_name="viscorough", message="%(prog)s %(version)s")
@click.pass_context
def cli(context: click.Context) -> None:
    """Penetration of rough rigid indenters into a linearly viscous half-space.

    \b
    Example: a map of heights in micrometres, points 2 um apart, pressed by 5 N into 1e6 Pa s:
        viscorough indent heights.npy --spacing 2 --unit um -o curve.nc
        viscorough kinetics curve.nc --force 5 --viscosity 1e6 -o kinetics.nc

    \b
    Completion of commands, options and files by the tab key, in bash (in zsh: zsh_source):
        eval "$(_VISCOROUGH_COMPLETE=bash_source viscorough)"
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


for _command in (
    indent.indent,
    contact.contact,
    kinetics.kinetics,
    march.march,
    reduce.reduce,
    generate.generate,
    estimate.estimate,
    plot.plot,
):
    cli.add_command(_command)


def main(arguments: list[str] | None = None) -> int:
    """Run the command line and return its exit code.

    arguments : texts that follow the name of the program; default: sys.argv[1:]
    """
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    if instruction := os.environ.get(_COMPLETE):
        return shell_complete(cli, {}, "viscorough", _COMPLETE, instruction)
    command = " ".join(["viscorough", *(name for name in arguments[:1] if name in cli.commands)])
    messages.escape_unencodable_characters()
    try:
        with (
            warnings.catch_warnings(record=True) as caught,
            cli.make_context("viscorough", arguments, obj=caught) as context,
        ):
            options.refuse_split_quantity(arguments)
            cli.invoke(context)
        for text in messages.warning_texts(caught):
            messages.complain(command, f"warning: {text}")
    except click.exceptions.Exit as done:
        return done.exit_code
    except BrokenPipeError:  # the reader of standard output has ended, as in viscorough --help | head
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
