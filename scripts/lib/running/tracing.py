"""The options of trace that commands pass on, and a check for options that mean nothing to trace."""
from lib.running.tool_options import given_words

VALUES = {
    "--sampling": ("basic|regular|jittered|adaptive", "where the rays of a pixel go"),
    "--threshold": ("N", "with --sampling adaptive, how much samples may differ"),
    "--min-contribution": ("E", "cast no ray for less than this part of a pixel's color"),
    "--max-depth": ("N", "how often a ray may be mirrored or refracted")}
FLAGS = {
    "--no-shadows": "light everything that faces a lamp",
    "--no-recursion": "draw mirrors and glass matte and opaque"}


def add_trace_options(parser):
    group = parser.add_argument_group("Ray tracing, as for trace")
    group.add_argument("--trace", action="store_true",
                       help="draw with trace, in place of project and zbuf: shadows, mirrors, glass, spheres")
    for option, (value, told) in VALUES.items():
        group.add_argument(option, metavar=value, help=told)
    for option, told in FLAGS.items():
        group.add_argument(option, action="store_true", help=told)


def trace_words(parser, options, meaningless=(), others=()):
    """The words for trace; `others` are further options of the command for trace alone. Ends the program if
    options for trace are given without --trace, or with --trace an option in `meaningless`, pairs of a given
    option (or None) and the reason why it means nothing to trace."""
    words = given_words(options, (*VALUES, *others, *FLAGS))
    if words and not options.trace:
        parser.error(f"{words[0]} is for trace: it needs --trace")
    if options.trace:
        for option, reason in meaningless:
            if option:
                parser.error(f"{option} means nothing with --trace: {reason}")
    return words
