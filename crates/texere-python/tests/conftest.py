"""Tests run in the repository's root, whose designs they read."""

import os
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[3]
os.chdir(ROOT)
