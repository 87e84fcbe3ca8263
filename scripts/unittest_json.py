"""Runs the unittest files (*_test.py) of a folder, and writes {"passed": n, "failed": n} to a file.

Usage: unittest_json.py FOLDER FILE
"""

import json
import sys
import unittest

suite = unittest.TestLoader().discover(sys.argv[1], pattern="*_test.py")
outcome = unittest.TextTestRunner(stream=sys.stderr, verbosity=2).run(suite)

# A test with several failed subtests is one failed test.
broken = {getattr(test, "test_case", test).id() for test, _ in outcome.failures + outcome.errors}
failed = len(broken) + len(outcome.unexpectedSuccesses)
passed = max(0, outcome.testsRun - failed - len(outcome.skipped))
with open(sys.argv[2], "w", encoding="utf-8") as report:
    json.dump({"passed": passed, "failed": failed}, report)
sys.exit(1 if failed else 0)
