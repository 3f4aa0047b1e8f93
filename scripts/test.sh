#!/usr/bin/env bash
# Every check: format, lints, tests (unit, GPU against CPU, whole program), documentation.
# MANYLIGHT_BLESS=1 rewrites the golden images, golden counters and the configuration schema instead of comparing.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --validation --browser --openexr

step() {
    printf '\n== %s\n' "$*"
    "$@"
}

step cargo fmt --all --check
# One profile and one set of features for everything, so that dependencies are built once.
step cargo clippy --release --locked --workspace --all-targets -- --deny warnings
step cargo build --release --locked --workspace --all-targets
step cargo test --release --locked --workspace
RUSTDOCFLAGS="--deny warnings" step cargo doc --release --locked --workspace --no-deps --document-private-items
