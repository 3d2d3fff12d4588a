"""Digests follow exactly the sources that a script uses."""

import textwrap

import pytest

from viscorough_study.run.source_digest import SourceDigests

FILES = {
    "src/viscorough/__init__.py": '_MODULE_OF = {"solve": "deep.solver"}\n',
    "src/viscorough/deep/__init__.py": "",
    "src/viscorough/deep/solver.py": '''
        """Of a subpackage."""
        from viscorough.deep import parts

        def solve(x):
            """Solve."""
            return parts.first(x, 3)
        ''',
    "src/viscorough/deep/parts.py": """
        TABLE = "table.csv"

        def first(x, limit):
            def inner():
                'Of a function inside.'
                return limit
            return inner() * x
        """,
    "src/viscorough/deep/data/table.csv": "a,b\n1,2\n",
    "src/viscorough_study/__init__.py": "",
    "src/viscorough_study/handed_on.py": "from viscorough.deep.parts import first as other\nOWN = 1\n",
    "src/viscorough_study/everything.py": "from viscorough.deep.parts import *\n",
    "scripts/direct.py": "from viscorough.deep.solver import solve\n\ndef main():\n    return solve(1)\n",
    "scripts/lazy.py": "from viscorough import solve\n",
    "scripts/attribute.py": "import viscorough\n",
    "scripts/inside.py": """
        def main():
            try:
                import nothing
            except ImportError:
                from viscorough_study import handed_on
        """,
    "scripts/again.py": "from viscorough_study.handed_on import other\n",
    "scripts/star.py": "from viscorough_study.everything import first\n",
    "scripts/nothing.py": "import json\n\ndef main():\n    return json.dumps(1)\n",
}
SOLVER = {"direct", "lazy", "attribute"}
PARTS = SOLVER | {"inside", "again", "star"}


@pytest.fixture
def project(tmp_path):
    for name, text in FILES.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))
    return tmp_path


def digests(project):
    """Return the digest of each script; results kept by an earlier run must not change it."""
    kept, result = project / ".snakemake/sources.json", []
    for file in (kept, project / "none.json"):
        sources = SourceDigests(project / "src", file)
        result.append({path.stem: sources.digest(path) for path in (project / "scripts").glob("*.py")})
        if file == kept:
            sources.keep()
    assert result[0] == result[1]
    return result[0]


def changed_by(project, name, old, new):
    """Return the scripts whose digest an edit changes."""
    before, path = digests(project), project / name
    text = path.read_text()
    assert text.count(old) == 1
    path.write_text(text.replace(old, new))
    after = digests(project)
    return {script for script in before if before[script] != after[script]}


@pytest.mark.parametrize(
    ("name", "old", "new", "scripts"),
    [
        ("src/viscorough/deep/solver.py", "(x, 3)", "(x, 4)", SOLVER),
        ("src/viscorough/deep/parts.py", "return limit", "return 2 * limit", PARTS),
        ("src/viscorough/deep/data/table.csv", "1,2", "1,3", PARTS),
        ("src/viscorough_study/handed_on.py", "OWN = 1", "OWN = 2", {"inside", "again"}),
        ("src/viscorough/__init__.py", '"deep.solver"', '"deep.parts"', {"lazy", "attribute"}),
        ("scripts/nothing.py", "dumps(1)", "dumps(2)", {"nothing"}),
        ("src/viscorough/deep/solver.py", '"""Solve."""', '"""Solve it,\n\n    in other words."""', set()),
        ("src/viscorough/deep/solver.py", '"""Of a subpackage."""', "# a comment", set()),
        ("src/viscorough/deep/parts.py", "'Of a function inside.'", "'Other words.'", set()),
        ("scripts/direct.py", "def main():", 'def main():  # a comment\n    """Say what it does."""', set()),
    ],
)
def test_change_counts_for_the_scripts_that_use_it(project, name, old, new, scripts):
    """Wording and layout do not count."""
    assert changed_by(project, name, old, new) == scripts


def test_relative_imports_are_refused(project):
    (project / "src/viscorough/deep/parts.py").write_text("from . import solver\n")
    with pytest.raises(ValueError, match="relative imports are not followed"):
        digests(project)
