"""Grading of many hand-ins, used by scripts/grade. It starts in graders.py."""
