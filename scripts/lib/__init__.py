"""Modules that several commands import."""
