#!/usr/bin/env bash
# other_system.sh SYSTEM SOURCE HMLFC OPENJPEG FOLDER: the library alone for another processor or for Windows, with Debian's
# compiler SYSTEM-g++ and the OpenJPEG of the archives in OPENJPEG; in qemu-user or Wine it passes the suite and encodes as
# recorded.
set -euo pipefail
system=$1 source=$2 hmlfc=$3 openjpeg=$4 folder=$5/$1
processor=${system%%-*} name=Linux threads='' emulator=qemu-$processor suffix='' targets=(codec)
if [[ $system == *mingw* ]]; then
  name=Windows threads=-posix emulator=wine suffix=.exe targets=(codec hmlfc_shared)
  export WINEPREFIX=$folder/wine WINEDEBUG=-all
fi
if ! type "$system-g++$threads" "$emulator" patch || ! ls "$openjpeg"/*.{orig,debian}.tar.xz; then
  echo "SKIPPED: one of these is not there"
  exit 77
fi
cmake -G Ninja -S "$source/tests/portable/alone" -B "$folder" -DCMAKE_BUILD_TYPE=None "-DCMAKE_C_FLAGS=-O1 -w" \
  "-DCMAKE_CXX_FLAGS=-O1 -Wno-psabi" -DHMLFC_WERROR=ON -DHMLFC_UNITY=ON -DHMLFC_OPENJPEG="$openjpeg" -DCMAKE_SYSTEM_NAME=$name \
  -DCMAKE_SYSTEM_PROCESSOR="$processor" -DCMAKE_C_COMPILER="$system-gcc$threads" -DCMAKE_CXX_COMPILER="$system-g++$threads"
cmake --build "$folder" --target "${targets[@]}"
if [[ $emulator == wine ]]; then  # a server that outlives the runs of the suite, whose processes end with each
  mkdir -p "$WINEPREFIX"
  wineserver -p || true  # where one runs already
  trap 'wineserver -k' EXIT
  wine wineboot
fi
codec="$emulator $folder/codec$suffix"
conform=("$hmlfc" conform --suite "$source/vectors" -o "$folder/report")
"${conform[@]}" --dut "$codec {input} {output}"
"${conform[@]}" --frames --dut "$codec {input} {record} {stop_level} {output}"
"$hmlfc" synth --force --scene cards --grid 4x5 --size 72x52 -o "$folder/cards"
"$hmlfc" encode --force --lossless "$folder/cards" -o "$folder/cards.hmlfc"
for profile in main extended; do
  $codec "$folder/cards.hmlfc" $profile "$folder/$profile"
  sum=$(sha256sum <"$folder/$profile")
  grep -F "\"encode cards --profile $profile --method hmlfc\": \"${sum%% *}\"" "$source/tests/cli/recorded_sums.json"
done
