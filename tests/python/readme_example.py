"""Runs the README's Python example as printed. Needs pyplatewash and nothing else."""

import re
from pathlib import Path

README = Path(__file__).resolve().parents[2] / "README.md"


def example() -> str:
    """The one Python block of the README."""
    blocks: list[str] = re.findall(r"^```python\n(.*?)^```$", README.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    (block,) = blocks
    return block


if __name__ == "__main__":
    exec(compile(example(), "README.md", "exec"), {})
