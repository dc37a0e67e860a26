#!/usr/bin/env bash
# Start-up of the commands that touch no image: median wall time of 21 runs each, in milliseconds.
# usage: benchmarks/pipeline/start_up.sh [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${1:-build/release/bin/skylapse}
measure() {
  local times=()
  for _ in $(seq 21); do
    local begin end
    begin=$(date +%s%N)
    "$program" "$@" >/dev/null 2>&1
    end=$(date +%s%N)
    times+=($(((end - begin) / 1000)))
  done
  printf '%8.1f ms   skylapse %s\n' "$(printf '%s\n' "${times[@]}" | sort -n | sed -n 11p | awk '{print $1 / 1000}')" "$*"
}
measure --help
measure sun --at 50.0755,14.4378,235 --time 2026-06-21T12:00Z
measure events --at 50.0755,14.4378,235 --zone Europe/Prague --date 2026-06-21
measure validate configs/prague_solstice.yaml
measure plan configs/prague_solstice.yaml
