"""Whether Heliostat agrees with Mitsuba 3 and Cycles: means of every channel, and a Z-test in every pixel; and which has the less noise for its time.

    python agree.py HELIOSTAT [--scene NAME] [--runs 16] [--samples 64] [--size 128] [--mesh OBJ] [--cycles PYTHON]
        [--set KEY=VALUE] [--out FOLDER]

All render each scene so many times with seeds of their own. The mean over the runs has a variance that the runs tell
themselves; pixels agree where Welch's test says so at 1 % for the whole picture (Sidak's correction), as Mitsuba's own tests
ask, or where the means are within 0.05 %. Efficiency is one over variance times seconds of processor time, in turns, a run of ours being a whole process. Needs `pip install mitsuba numpy scipy`, and for variant llvm_ad_rgb an LLVM (`DRJIT_LIBLLVM_PATH`).
Cycles joins where a Python is named that has it (`pip install bpy`; its NumPy is not that of the others).
"""

import argparse
import json
import pathlib
import resource
import subprocess
import sys

import mitsuba as mi

ARGS = argparse.ArgumentParser()
ARGS.add_argument("heliostat")
ARGS.add_argument("--scene", default="")
ARGS.add_argument("--runs", type=int, default=16)
ARGS.add_argument("--samples", type=int, default=64)
ARGS.add_argument("--size", type=int, default=128)
ARGS.add_argument("--mesh")
ARGS.add_argument("--integrator", default="path")
ARGS.add_argument("--threads", type=int, default=2)
ARGS.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a setting of ours, as for heliostat render")
ARGS.add_argument("--cycles", help="a Python that has bpy")
ARGS.add_argument("--variant", default="llvm_ad_rgb")
ARGS.add_argument("--out", default="out/agree")
args = ARGS.parse_args()
mi.set_variant(args.variant)

import numpy as np
from scipy import stats

from scenes import named, sky_rows
from to_heliostat import to_toml
from to_mitsuba import to_mitsuba

out = pathlib.Path(args.out)
out.mkdir(parents=True, exist_ok=True)
size = [args.size, args.size]


def sky_file():
    """The sky as a file."""
    file = out / "sky.exr"
    mi.Bitmap(np.array(list(sky_rows(1024)), dtype=np.float32)).write(str(file))
    return str(file.resolve())


def seconds():
    """Processor time of this process and of those that it waited for."""
    return sum(usage.ru_utime + usage.ru_stime for usage in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


def timed(work):
    """The seconds that work took."""
    start = seconds()
    work()
    return seconds() - start


def read(file):
    return np.array(mi.Bitmap(str(file)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32))


def ours(name, scene):
    """What renders the scene once with a seed: gives the picture and the seconds it took."""
    file, result = out / f"{name}.toml", out / f"{name}.exr"
    command = [args.heliostat, "render", str(file), "-o", str(result), "--exr-depth", "float", "--progress", "none"]
    command += ["--threads", str(args.threads), *(word for pair in args.set for word in ["--set", pair])]

    def render(seed):
        file.write_text(to_toml(scene, size, args.samples, seed, args.integrator))
        took = timed(lambda: subprocess.run(command, check=True, stdout=subprocess.DEVNULL))
        return read(result), took

    return render


def mitsuba(scene):
    world = to_mitsuba(scene, size, {"type": "path", "max_depth": 65, "rr_depth": 8})

    def render(seed):
        pictures = []
        took = timed(lambda: pictures.append(np.array(mi.render(world, spp=args.samples, seed=1000 + seed))))
        return pictures[0], took

    return render


def cycles(name, scene):
    """It tells its seconds itself, for rendering alone."""
    file, result = out / f"{name}.json", (out / f"{name}_cycles.exr").resolve()
    file.write_text(json.dumps(scene))
    script = pathlib.Path(__file__).parent / "with_cycles.py"

    def render(seed):
        numbers = [args.size, args.samples, seed, args.threads]
        command = [args.cycles, script, file, result, *numbers]
        said = subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout
        return read(result), float(said.split("seconds")[-1])

    return render


def in_turns(renderers):
    """For each renderer the pictures of all runs, and the median of their seconds."""
    for render in renderers:
        # The first run compiles.
        render(args.runs)
    runs = [[render(seed) for render in renderers] for seed in range(args.runs)]
    pictures_and_seconds = (zip(*of_one) for of_one in zip(*runs))
    return [(np.array(pictures, dtype=np.float64), np.median(times)) for pictures, times in pictures_and_seconds]


def picture(name, values):
    mi.util.write_bitmap(str(out / name), mi.Bitmap(values.astype(np.float32)))


def report(name, a, b):
    """One line; whether they agree. Each is pictures and seconds."""
    (a, our_seconds), (b, their_seconds) = a, b
    noise = lambda x: np.mean(x.var(axis=0, ddof=1))
    relative = lambda x: np.mean(x.var(axis=0, ddof=1) / (x.mean(axis=0) ** 2 + 1e-2))
    gain = their_seconds / our_seconds
    means = a.mean(axis=(0, 1, 2)) / b.mean(axis=(0, 1, 2)) - 1
    spread = lambda x: x.mean(axis=(1, 2)).std(axis=0, ddof=1) / np.sqrt(len(x)) / x.mean(axis=(0, 1, 2))
    p = np.nan_to_num(stats.ttest_ind(a, b, axis=0, equal_var=False).pvalue, nan=1.0)
    # Where the sky is seen there is hardly a variance, and interpolation differs in the fourth digit.
    p = np.where(np.abs(a.mean(axis=0) - b.mean(axis=0)) < 5e-4 * b.mean(axis=0), 1.0, p)
    inside = np.mean(p > 1 - (1 - 0.01) ** (1 / p[..., 0].size))
    plain = np.mean(p > 0.01)
    stem = name.lower().replace(", ", "_")
    picture(f"{stem}_ours.png", a.mean(axis=0))
    picture(f"{stem}_theirs.png", b.mean(axis=0))
    picture(f"{stem}_p.png", np.minimum(p, 1))
    shown = " ".join(f"{100 * x:+.3f} %" for x in means)
    error = " ".join(f"{100 * x:.3f}" for x in np.hypot(spread(a), spread(b)))
    print(
        f"{name}: means {shown} (deviation {error}); {100 * inside:.2f} % of pixels inside, {100 * plain:.2f} % uncorrected; "
        f"variance {noise(a) / noise(b):.2f}, seconds {our_seconds:.2f} to {their_seconds:.2f}; efficiency {gain * noise(b) / noise(a):.2f}, by relative error {gain * relative(b) / relative(a):.2f}"
    )
    return np.all(np.abs(means) < 0.005) and inside >= 0.995


def compare(name, scene):
    """Whether all peers agree on a scene."""
    peers = {"Mitsuba": mitsuba(scene)} | ({"Cycles": cycles(name, scene)} if args.cycles else {})
    our_runs, *theirs = in_turns([ours(name, scene), *peers.values()])
    return all([report(f"{name}, {peer}", our_runs, runs) for peer, runs in zip(peers, theirs)])


mi.set_log_level(mi.LogLevel.Error)
scenes = named(args.mesh, args.mesh and sky_file())
sys.exit(0 if all([compare(name, scene) for name, scene in scenes.items() if args.scene in name]) else 1)
