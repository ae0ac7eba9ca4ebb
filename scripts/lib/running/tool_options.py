"""Options of the tools that several commands take and pass on."""
CLIPS = ("auto", "near", "frustum", "reject", "none")


def add_options_of_project(group):
    group.add_argument("--aspect", choices=["angle", "ratio"], help="the meaning of a perspective's aspect")
    group.add_argument("--clip", choices=CLIPS, help="where triangles are cut")
    group.add_argument("--cull", choices=["back", "front"], help="the side of triangles to drop")


def words_of_project(options):
    """The words of the options of project that were given."""
    given = {"--aspect": options.aspect, "--clip": options.clip, "--cull": options.cull}
    return [word for option, value in given.items() if value for word in (option, value)]
