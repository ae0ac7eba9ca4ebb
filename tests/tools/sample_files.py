"""The files of samples, also of those whose stage texts are kept as sums alone (samples/SHA256SUMS)."""
import subprocess

STAGES = ("model", "view", "project")


def sample_file(bin_dir, sample, name):
    """The bytes of a file of the folder `sample`; a stage text that is not there is made as by
    Makefile.samples."""
    if (sample / name).exists():
        return (sample / name).read_bytes()
    number, text = int(name.removeprefix("stage").removesuffix(".txt")), (sample / "scene.txt").read_bytes()
    for stage in STAGES[:number]:
        is_last = stage == STAGES[number - 1]
        words = ["--digits", "exact"] if not is_last else ["--bare"] if number < 3 else []
        text = subprocess.run([bin_dir / stage, *words], input=text, stdout=subprocess.PIPE,
                              check=True).stdout
    return text
