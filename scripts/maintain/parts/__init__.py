"""The modules of the commands that maintain the project."""
