"""How Sphinx builds the pages in this folder into build/docs (`make docs`); nothing is loaded from the network."""

import importlib.metadata
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))  # for sphinx_viscorough

project = "viscorough"
author = "the authors of viscorough"
release = importlib.metadata.version("viscorough")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_viscorough"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
nitpicky = True  # a reference that leads nowhere is a warning, and warnings are errors
nitpick_ignore_regex = [("py:class", "array|bool|float|int|str")]  # types of attributes, in words
html_math_renderer = "mathml"

autodoc_default_options = {"members": True, "member-order": "bysource"}
autodoc_preserve_defaults = True
autodoc_typehints = "none"  # docstrings say more
napoleon_google_docstring = False
napoleon_use_param = False
napoleon_use_rtype = False

html_theme = "furo"
html_title = f"viscorough {release}"
html_copy_source = False
html_show_sphinx = False
