"""The modules of the commands that measure."""
