"""Options of the tools that several commands take and pass on."""
CLIPS = ("auto", "near", "frustum", "reject", "none")


def add_options_of_project(group):
    group.add_argument("--aspect", choices=["angle", "ratio"], help="the meaning of a perspective's aspect")
    group.add_argument("--clip", choices=CLIPS, help="where triangles are cut")
    group.add_argument("--cull", choices=["back", "front"], help="the side of triangles to drop")


def words_of_project(options):
    return given_words(options, ("--aspect", "--clip", "--cull"))


def given_words(options, names):
    """The words of the options with these names that were given."""
    words = []
    for name in names:
        value = getattr(options, name.lstrip("-").replace("-", "_"))
        if value is not None and value is not False:
            words += [name, *(() if value is True else value if isinstance(value, list) else [str(value)])]
    return words
