#!/usr/bin/env bash
# Installs what is missing, builds, and replays the default (or whatever `manylight replay` arguments are given).
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh
cargo build --release --locked --package manylight
exec "${CARGO_TARGET_DIR:-target}/release/manylight" replay "$@"
