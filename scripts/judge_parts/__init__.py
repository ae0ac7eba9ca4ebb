"""The judge of hand-ins. It starts in judge.py."""
