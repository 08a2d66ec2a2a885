#!/usr/bin/env bash
# other_debian.sh x86_64|aarch64|fpga SOURCE FOLDER: the commit of SOURCE in a clean Debian 13, made in FOLDER, one for each.
# x86_64: ./run test; fpga: ./run fpga. aarch64: cross-built; its unit tests, the suite and an encoding run in qemu-user.
set -euo pipefail
processor=$1 source=$2 root=$3/$1

# inside WHAT: what runs there.
inside() {
  export DEBIAN_FRONTEND=noninteractive
  cd /root/hmlfc
  if [[ $1 != aarch64 ]]; then
    CI=true ./run "${1/x86_64/test}"
    return
  fi
  local root=$PWD name names packages=()
  source tools/packages.sh
  mapfile -t names < <(packages build unit)
  dpkg --add-architecture arm64
  apt-get -q update
  for name in "${names[@]}"; do
    if [[ $name =~ ^z?lib ]] && ! apt-cache show "$name" | grep -q '^Architecture: all'; then name+=:arm64; fi
    packages+=("$name")
  done
  apt-get -q install -y --no-install-recommends "${packages[@]}" g++-aarch64-linux-gnu qemu-user
  export PKG_CONFIG_LIBDIR=/usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig
  cmake --preset release -DHMLFC_TESTS=unit -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
    -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
    -DCMAKE_LIBRARY_ARCHITECTURE=aarch64-linux-gnu -DCMAKE_CROSSCOMPILING_EMULATOR=qemu-aarch64
  cmake --build build/release
  ctest --test-dir build/release -LE soak --output-on-failure
  local program="qemu-aarch64 $PWD/build/release/tools/hmlfc"
  $program conform --suite vectors --dut "$program decode {input} -o {output}" -o /root/conform
}

if ((EUID != 0)) || ! command -v debootstrap >/dev/null; then
  echo "SKIPPED: root and debootstrap make the other system"
  exit 77
fi
if [[ ! -f $root/made ]]; then
  rm -rf --one-file-system "$root"
  mkdir -p "$root"
  debootstrap --variant=buildd --include=ca-certificates,git trixie "$root"
  touch "$root/made"
fi
rm -rf "$root/root/hmlfc"
git clone -q "$source" "$root/root/hmlfc"
declare -f inside >"$root/root/inside.sh"
echo "set -euo pipefail; inside $processor" >>"$root/root/inside.sh"
# The mounts go with the namespace.
unshare --mount bash -c 'for folder in proc sys dev dev/pts; do mount --bind "/$folder" "$1/$folder"; done
  chroot "$1" bash /root/inside.sh' mounts "$root"
