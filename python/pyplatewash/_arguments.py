"""Arguments of functions that are written in Python: what is wrong with one is told by its name, in the words of the compiled part."""

from ._core import _argument_count as count
from ._core import _argument_flag as flag
from ._core import _argument_number as number
from ._core import _argument_path as path
from ._core import _argument_shown as shown
from ._core import _argument_texts as texts
from ._core import _argument_word as word

__all__ = ["count", "flag", "number", "path", "shown", "texts", "word"]
