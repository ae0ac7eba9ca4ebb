"""The modules of trade."""
