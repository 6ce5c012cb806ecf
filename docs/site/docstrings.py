"""Docstrings for the page of the Python API."""

import inspect
import re
from pydoc import locate
from typing import Any

import griffe

COMPILED = "pyplatewash._core."
# A paragraph that starts with the interpreter's prompt.
EXAMPLE = re.compile(r"^>>> .*(?:\n.+)*", re.MULTILINE)


class Docstrings(griffe.Extension):
    """Takes the docstrings of the compiled part from the installed wheel, as its stub has types alone, and marks examples as code."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        if obj.path.startswith(COMPILED):
            text = inspect.getdoc(locate(obj.path))
            obj.docstring = griffe.Docstring(text, parent=obj) if text else None
        mark_examples(obj)

    def on_package(self, *, pkg: griffe.Module, **_: Any) -> None:
        mark_examples(pkg)


def mark_examples(item: griffe.Object) -> None:
    if item.docstring:
        item.docstring.value = EXAMPLE.sub("```pycon\n\\g<0>\n```", item.docstring.value)
