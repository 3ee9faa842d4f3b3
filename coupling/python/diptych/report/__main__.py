# diptych: the program `diptych` runs python3 -m diptych.report WHAT DIR [NEXT] for pages and pictures
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exit codes: 0 done, 2 wrong input (usage, missing or broken file, another format), 4 a module is missing or a file
cannot be written."""

import gc
import sys

from . import DRAWINGS, draw


def main(arguments):
    if len(arguments) not in (2, 3) or arguments[0] not in DRAWINGS:
        print(f"report: usage: python3 -m diptych.report {'|'.join(DRAWINGS)} DIR [NEXT]", file=sys.stderr)
        return 2
    gc.disable()  # saves a twentieth of the time of a page
    try:
        draw(*arguments)
    except (ValueError, OSError, ImportError) as error:
        print(f"report: {error}", file=sys.stderr)
        return 2 if isinstance(error, ValueError) else 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
