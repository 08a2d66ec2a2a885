#!/usr/bin/env bash
# other_processor.sh SYSTEM SOURCE HMLFC OPENJPEG FOLDER: the library alone for another processor, with Debian's compiler
# SYSTEM-g++ and the OpenJPEG of the archives in OPENJPEG; in qemu-user it passes the suite and encodes as recorded.
set -euo pipefail
system=$1 source=$2 hmlfc=$3 openjpeg=$4 folder=$5/$1
processor=${system%%-*}
if ! type "$system-g++" "qemu-$processor" patch || ! ls "$openjpeg"/*.{orig,debian}.tar.xz; then
  echo "SKIPPED: one of these is not there"
  exit 77
fi
cmake -G Ninja -S "$source/tests/portable/alone" -B "$folder" -DCMAKE_BUILD_TYPE=None "-DCMAKE_C_FLAGS=-O1 -w" \
  "-DCMAKE_CXX_FLAGS=-O1 -Wno-psabi" -DHMLFC_WERROR=ON -DHMLFC_UNITY=ON -DHMLFC_OPENJPEG="$openjpeg" -DCMAKE_SYSTEM_NAME=Linux \
  -DCMAKE_SYSTEM_PROCESSOR="$processor" -DCMAKE_C_COMPILER="$system-gcc" -DCMAKE_CXX_COMPILER="$system-g++"
cmake --build "$folder" --target codec
codec="qemu-$processor $folder/codec"
conform=("$hmlfc" conform --suite "$source/vectors" -o "$folder/report")
"${conform[@]}" --dut "$codec {input} {output}"
"${conform[@]}" --frames --dut "$codec {input} {record} {stop_level} {output}"
"$hmlfc" synth --force --scene cards --grid 4x5 --size 72x52 -o "$folder/cards"
"$hmlfc" encode --force --lossless "$folder/cards" -o "$folder/cards.hmlfc"
for profile in main extended; do
  sum=$($codec "$folder/cards.hmlfc" $profile /dev/stdout | sha256sum)
  grep -F "\"encode cards --profile $profile --method hmlfc\": \"${sum%% *}\"" "$source/tests/cli/recorded_sums.json"
done
