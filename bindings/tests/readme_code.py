#!/usr/bin/env python3
"""Prints the first program of a README, so that it can be run: readme_code.py README LANGUAGE

LANGUAGE is the word after the three back quotes. Fails where there is none.
"""
import re
import sys

path, language = sys.argv[1:]
found = re.search(rf"^```{re.escape(language)}\n(.*?)^```$", open(path, encoding="utf-8").read(), re.DOTALL | re.MULTILINE)
print(found[1] if found else sys.exit(f"{path} has no program in {language}"), end="")
