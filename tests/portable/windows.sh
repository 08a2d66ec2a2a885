#!/usr/bin/env bash
# windows.sh SOURCE HMLFC OPENJPEG FOLDER: the program for Windows passes its own suite in Wine, encodes as recorded, and gives
# bytes as HMLFC does, with any names of files.
set -euo pipefail
source=$1 hmlfc=$2 openjpeg=$3 folder=$4/windows
export WINEPREFIX=$folder/wine WINEDEBUG=-all
if ! type x86_64-w64-mingw32-g++-posix wine patch; then
  echo "SKIPPED: one of these is not there"
  exit 77
fi
(cd "$source" && cmake --preset windows -B "$folder" -DHMLFC_WERROR=ON -DHMLFC_OPENJPEG="$openjpeg")
cmake --build "$folder" --target hmlfc_cli
trap 'wineserver -k' EXIT
program=(wine "$folder/tools/hmlfc.exe")
"${program[@]}" conform --suite "$source/vectors" -o "$folder/report" --dut "$folder/tools/hmlfc.exe decode {input} -o {output}"
views=$folder/vües光
"${program[@]}" synth --force --scene cards --grid 4x5 --size 72x52 -o "$views"
for profile in main extended; do
  "${program[@]}" encode --force "$views" --profile $profile --method hmlfc -o "$views.hmlfc"
  sum=$(sha256sum <"$views.hmlfc")
  grep -F "\"encode cards --profile $profile --method hmlfc\": \"${sum%% *}\"" "$source/tests/cli/recorded_sums.json"
done
cmp <("${program[@]}" render "$views.hmlfc" -o -) <("$hmlfc" render "$views.hmlfc" -o -)
if compgen -G "$folder/*.partial-*"; then exit 1; fi
