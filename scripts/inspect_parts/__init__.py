"""The modules of scripts/inspect, and the parts of the page it writes."""
