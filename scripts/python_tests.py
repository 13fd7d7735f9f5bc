"""Runs the tests of a Python module as ./collektive test wants it: the last line is "N passed, N failed"."""
import sys
import unittest


def run(module, names):
    """Runs all tests of a module, or those named; ends the process with code 1 when one failed."""
    loader = unittest.defaultTestLoader
    suite = loader.loadTestsFromNames(names, module) if names else loader.loadTestsFromModule(module)
    result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout).run(suite)
    failed = len(result.failures) + len(result.errors)
    print(f"{result.testsRun - min(failed, result.testsRun)} passed, {failed} failed")
    sys.exit(1 if failed else 0)
