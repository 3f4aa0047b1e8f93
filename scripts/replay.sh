#!/usr/bin/env bash
# Installs what is missing, builds, replays the default (or whatever `manylight replay` arguments are given), and ends
# with the path of the report on it.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh
cargo build --release --locked --package manylight
# Frames near 300 and 580, which the thesis shows, make the report worth looking at.
[ $# -gt 0 ] || set -- --exr 280,560
exec "${CARGO_TARGET_DIR:-target}/release/manylight" replay --report "$@"
