"""The table of scripts/measure/sampling."""


def report(rows):
    """Markdown, a line for each way to sample and each N."""
    base = float(rows[0]["cpu_seconds"])
    lines = ["| samples | N | rays a pixel | error | CPU, ms | times one ray |", "|---|--:|--:|--:|--:|--:|"]
    for row in rows:
        seconds = float(row["cpu_seconds"]) if row["cpu_seconds"] else None
        time, ratio = (f"{1e3 * seconds:.0f}", f"{seconds / base:.1f}") if seconds else ("", "")
        lines.append(
            f"| {row['samples']} | {row['n']} | {float(row['rays']):.1f} | {float(row['error']):.2f} | "
            f"{time} | {ratio} |"
        )
    first = rows[0]
    return "\n".join([
        *lines, "",
        f"Error: of a channel, from 0 to 255, against {first['fine']} x {first['fine']} samples a pixel, the "
        f"root of the mean "
        f"square over {first['size']} pixels of the sample `shaded-torus`. Rays and CPU: of "
        f"{first['timed_size']} pixels, the median of "
        f"{first['rounds']} runs on one thread, {first['machine']}.", ""])
