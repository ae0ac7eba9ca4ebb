"""The modules of scripts/explain."""
