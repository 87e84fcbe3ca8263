"""Runs the unittest files (*_test.py) of a folder; the last line printed is {"passed": n, "failed": n}."""

import json
import sys
import unittest

suite = unittest.TestLoader().discover(sys.argv[1], pattern="*_test.py")
outcome = unittest.TextTestRunner(stream=sys.stderr, verbosity=2).run(suite)
failed = len(outcome.failures) + len(outcome.errors) + len(outcome.unexpectedSuccesses)
print(json.dumps({"passed": outcome.testsRun - failed - len(outcome.skipped), "failed": failed}))
sys.exit(1 if failed else 0)
