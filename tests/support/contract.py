"""The contract of the command line for a user's mistake: one line on stderr, exit code 2, no file."""

from viscorough.cli import main


def complaint(arguments, capsys, folder):
    """The one line with which the command line refuses the arguments; no file of the folder is made or changed."""
    before = _contents(folder)
    code = main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    assert (code, captured.out) == (2, ""), captured
    assert captured.err.startswith(f"viscorough {arguments[0]}: ")
    assert len(captured.err.splitlines()) == 1
    assert captured.err.endswith("\n")
    assert "Traceback" not in captured.err
    assert _contents(folder) == before
    return captured.err


def _contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
