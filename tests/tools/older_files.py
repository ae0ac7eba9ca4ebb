"""Shared by the failure tests: a run of each tool, and an older image that stays if a run fails."""
import pathlib

from toolbox import ToolTest, run, tool_inputs

OLD_IMAGE = b"an older image"


class OlderImageTest(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text("6 6\n")  # trace shows the triangle, too: a center is in it
        pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)

    def good_run(self, tool, operands, text):
        """(stdout, image) of a run without a fault; the older image is put back."""
        done = run(tool, *operands, stdin=text)
        self.assert_quiet_success(done)
        image = pathlib.Path("out.bmp").read_bytes()
        pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
        return done.stdout, image

    def assert_as_before(self):
        self.assertEqual(pathlib.Path("out.bmp").read_bytes(), OLD_IMAGE)
        self.assertEqual(self.files(), ["config.txt", "out.bmp", "scene.txt"])
