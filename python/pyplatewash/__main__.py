"""``python -m pyplatewash`` is the command ``platewash``."""

from ._command import main

if __name__ == "__main__":
    main()
