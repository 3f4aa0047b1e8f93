#!/usr/bin/env bash
# Installs what manylight needs and this machine lacks: a C++ compiler, the Vulkan loader, and lavapipe where no GPU
# driver is there. With --validation also the validation layers, with --browser also Chromium, in which reports are
# tested, with --openexr also OpenEXR's own programs, which read images in tests, with --packaging what Debian packages are
# made with. Idempotent, asks nothing, needs root or sudo only when something is missing.
set -euo pipefail

packages=()

need_command() { # COMMAND PACKAGE
    command -v "$1" >/dev/null 2>&1 || packages+=("$2")
}

has_library() { # NAME
    # Not every shell has /sbin in its path.
    PATH="$PATH:/sbin:/usr/sbin" ldconfig -p | grep -q "$1"
}

has_driver() {
    [ -n "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] && return 0
    local directory
    for directory in /usr/share/vulkan/icd.d /etc/vulkan/icd.d /usr/local/share/vulkan/icd.d "$HOME/.local/share/vulkan/icd.d"; do
        compgen -G "$directory/*.json" >/dev/null && return 0
    done
    return 1
}

has_validation() {
    local directory
    for directory in /usr/share/vulkan/explicit_layer.d /etc/vulkan/explicit_layer.d /usr/local/share/vulkan/explicit_layer.d; do
        compgen -G "$directory/VkLayer_khronos_validation*.json" >/dev/null && return 0
    done
    return 1
}

has_browser() {
    local name
    for name in chromium chromium-browser google-chrome; do
        command -v "$name" >/dev/null 2>&1 && return 0
    done
    return 1
}

need_command g++ g++
need_command git git
has_library libvulkan.so.1 || packages+=(libvulkan1)
has_driver || packages+=(mesa-vulkan-drivers)
for option in "$@"; do
    case "$option" in
        --validation) has_validation || packages+=(vulkan-validationlayers) ;;
        --browser) has_browser || packages+=(chromium) ;;
        --openexr) need_command exrmultipart openexr ;;
        --packaging) need_command dpkg-shlibdeps dpkg-dev ;;
        *)
            echo "setup: unknown option $option: use --validation, --browser, --openexr or --packaging" >&2
            exit 2
            ;;
    esac
done

if [ ${#packages[@]} -gt 0 ]; then
    if ! command -v apt-get >/dev/null 2>&1; then
        echo "setup: please install (names as on Debian): ${packages[*]}" >&2
        exit 2
    fi
    as_root=()
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    echo "setup: installing ${packages[*]}" >&2
    "${as_root[@]}" apt-get update -qq
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}" >/dev/null
fi

if ! command -v cargo >/dev/null 2>&1; then
    echo "setup: cargo is missing: install Rust from https://rustup.rs" >&2
    exit 2
fi
