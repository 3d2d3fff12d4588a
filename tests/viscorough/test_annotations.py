"""What the type checker does not ask for: an annotation of everything that is not a compiled kernel."""

import ast

from support.documentation import ROOT


def lacks_annotation(function):
    arguments = function.args
    named = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, arguments.vararg, arguments.kwarg]
    return function.returns is None or any(
        argument.annotation is None
        for argument in named
        if argument is not None and argument.arg not in ("self", "cls")
    )


def test_all_functions_but_kernels_are_annotated():
    missing, annotated = [], 0
    for path in (ROOT / "src/viscorough").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.FunctionDef) and not any("njit" in ast.dump(each) for each in node.decorator_list):
                annotated += 1
                if lacks_annotation(node):
                    missing.append(f"{path.name}: {node.name}")
    assert not missing
    assert annotated > 600
