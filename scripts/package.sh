#!/usr/bin/env bash
# Builds a Debian package, target/debian/manylight_VERSION_ARCHITECTURE.deb, and prints its path.
# It depends on the Vulkan loader and recommends Mesa's drivers, with lavapipe among them, or any other; it brings shell
# completions, licences, documentation and the configurations. With --test it is then installed by apt (as root or with
# sudo), a replay is made in an empty directory, and it is removed again.
set -euo pipefail
cd "$(dirname "$0")/.."

cargo_deb_version=3.8.0
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
test=false

case "${1:-}" in
    "") ;;
    --test) test=true ;;
    *)
        echo "package: unknown option $1: use --test, or none" >&2
        exit 2
        ;;
esac

make_package() {
    scripts/setup.sh --packaging
    cargo build --release --locked --package manylight
    mkdir -p "$target/release/completions"
    local shell
    for shell in bash zsh fish; do
        "$target/release/manylight" completions "$shell" >"$target/release/completions/manylight.$shell"
    done
    # A tool of its own version, apart from those of the machine.
    cargo install cargo-deb --version "$cargo_deb_version" --locked --quiet --root "$target/tools"
    # Equal sources give equal bytes.
    SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || echo 0)
    export SOURCE_DATE_EPOCH
    "$target/tools/bin/cargo-deb" --package manylight --no-build --strip --no-dbgsym --quiet --output "$target/debian" >/dev/null
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

test_package() { # FILE.deb
    # Not local: the trap outlives the function.
    empty=$(mktemp -d)
    trap 'rm -rf "$empty"; as_root apt-get remove -y -qq manylight >/dev/null' EXIT
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --reinstall "$1" >/dev/null
    (
        cd "$empty"
        /usr/bin/manylight replay --frames 300 --resolution 64x36 --method indi-persp-64 --method all-lights --exr 300
        /usr/bin/manylight export out --out results.csv
    )
    local file
    for file in out/summary.csv out/indi-persp-64/run.json out/indi-persp-64/frames/000300.exr results.csv; do
        [ -s "$empty/$file" ] || { echo "package: the installed program wrote no $file" >&2; exit 1; }
    done
    for file in bash-completion/completions/manylight doc/manylight/copyright doc/manylight/README.md; do
        [ -s "/usr/share/$file" ] || { echo "package: $file was not installed" >&2; exit 1; }
    done
}

make_package
package=$(ls -t "$target"/debian/manylight_*.deb | head -1)
if $test; then
    test_package "$package"
fi
echo "$package"
