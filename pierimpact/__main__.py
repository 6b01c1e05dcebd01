"""Lets `python -m pierimpact` stand for `pierimpact`."""

import sys

from pierimpact.cli import main

sys.exit(main())
