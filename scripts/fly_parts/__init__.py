"""The modules of scripts/fly."""
