#!/usr/bin/env bash
# The demo as one measurement: frames per second, where the time goes, processor time, peak memory, and
# whether the memory grows with the length of the job. usage: benchmarks/pipeline/demo.sh [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/../.."
program=$(realpath "${1:-build/release/bin/skylapse}")
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
python3 - "$program" "$out" <<'PYTHON'
import json, os, resource, subprocess, sys
program, out = sys.argv[1:]
def run(folder, *more):
    process = subprocess.Popen([program, "render", "configs/prague_solstice.yaml", "-o", folder, "--json", "-q", *more],
                               stdout=subprocess.PIPE)
    text = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0, text
    return json.loads(text), usage
whole, usage = run(out + "/whole")
n = whole["rendered"]
print(f"cores {len(os.sched_getaffinity(0))}, frames {n}, {whole['seconds']:.1f} s, {n / whole['seconds']:.2f} frames/s, "
      f"movie {whole['movie_seconds']:.1f} s of it")
print("per frame [ms of a thread]: " + ", ".join(f"{k} {v / n:.1f}" for k, v in whole["stage_milliseconds"].items()))
print(f"processor time {usage.ru_utime + usage.ru_stime:.1f} s, peak memory {usage.ru_maxrss / 1024:.0f} MiB, "
      f"written {whole['bytes_written'] / 1e6:.0f} MB")
_, few = run(out + "/few", "--frames", "1-x20")
print(f"peak memory with every 20th frame {few.ru_maxrss / 1024:.0f} MiB")
again, _ = run(out + "/whole")
print(f"resume of the finished job: {again['kept']} kept, {again['rendered']} rendered, {again['seconds']:.1f} s")
PYTHON
