"""Runs the unittest files (*_test.py) of a folder; the last line printed is {"passed": n, "failed": n}."""

import json
import sys
import unittest

suite = unittest.TestLoader().discover(sys.argv[1], pattern="*_test.py")
outcome = unittest.TextTestRunner(stream=sys.stderr, verbosity=2).run(suite)

# A test with several failed subtests is one failed test.
broken = {getattr(test, "test_case", test).id() for test, _ in outcome.failures + outcome.errors}
failed = len(broken) + len(outcome.unexpectedSuccesses)
passed = max(0, outcome.testsRun - failed - len(outcome.skipped))
print(json.dumps({"passed": passed, "failed": failed}))
sys.exit(1 if failed else 0)
