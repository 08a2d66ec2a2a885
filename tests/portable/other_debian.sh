#!/usr/bin/env bash
# other_debian.sh RELEASE_WHAT SOURCE FOLDER: the commit of SOURCE in a clean Debian 12 or 13, made in FOLDER, one for each.
# 13_x86_64: ./run test; 13_fpga: ./run fpga. Processors are cross-built for; unit tests and the suite run in qemu-user.
set -euo pipefail
what=${1#*_} source=$2 root=$3/$1 suite=trixie
if [[ $1 == 12_* ]]; then suite=bookworm; fi

# inside WHAT: what runs there.
inside() {
  export DEBIAN_FRONTEND=noninteractive
  cd /root/hmlfc
  if [[ $1 == x86_64 || $1 == fpga ]]; then
    CI=true ./run "${1/x86_64/test}"
    return
  fi
  local root=$PWD system=$1-linux-gnu name names packages=()
  source tools/packages.sh
  mapfile -t names < <(packages build unit)
  dpkg --add-architecture "${1/aarch64/arm64}"
  apt-get -q update
  for name in "${names[@]}"; do
    if [[ $name =~ ^z?lib && $(apt-cache show "$name") != *$'\n'"Architecture: all"* ]]; then name+=":${1/aarch64/arm64}"; fi
    packages+=("$name")
  done
  apt-get -q install -y --no-install-recommends "${packages[@]}" "g++-$system" qemu-user
  export PKG_CONFIG_LIBDIR="/usr/lib/$system/pkgconfig:/usr/share/pkgconfig"
  cmake --preset release -DHMLFC_TESTS=unit -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR="$1" \
    -DCMAKE_C_COMPILER="$system-gcc" -DCMAKE_CXX_COMPILER="$system-g++" \
    -DCMAKE_LIBRARY_ARCHITECTURE="$system" -DCMAKE_CROSSCOMPILING_EMULATOR="qemu-$1"
  cmake --build build/release
  ctest --test-dir build/release -LE soak --output-on-failure
  local program="qemu-$1 $PWD/build/release/tools/hmlfc"
  $program conform --timeout 600 --suite vectors --dut "$program decode {input} -o {output}" -o /root/conform
}

if ((EUID != 0)) || ! command -v debootstrap >/dev/null; then
  echo "SKIPPED: root and debootstrap make the other system"
  exit 77
fi
if [[ ! -f $root/made ]]; then
  rm -rf --one-file-system "$root"
  mkdir -p "$root"
  debootstrap --variant=buildd --include=ca-certificates,git $suite "$root"
  touch "$root/made"
fi
rm -rf "$root/root/hmlfc"
git clone -q "$source" "$root/root/hmlfc"
declare -f inside >"$root/root/inside.sh"
echo "set -euo pipefail; inside $what" >>"$root/root/inside.sh"
# The mounts go with the namespace.
unshare --mount bash -c 'for folder in proc sys dev dev/pts; do mount --bind "/$folder" "$1/$folder"; done
  chroot "$1" bash /root/inside.sh' mounts "$root"
