"""Marks this folder for pytest, so that tests in folders below import its modules."""
