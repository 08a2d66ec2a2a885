#!/usr/bin/env bash
# check_install.sh CMAKE BUILD_DIR COMPILER LIBDIR: installs the build into BUILD_DIR/consumer/prefix,
# then builds and runs the consumer beside this script twice, by find_package and by pkg-config.
set -euo pipefail
cmake=$1 build_dir=$2 compiler=$3 libdir=$4
source_dir=$(cd "$(dirname "$0")" && pwd)
work=$build_dir/consumer
prefix=$work/prefix

rm -rf "$work"
"$cmake" --install "$build_dir" --prefix "$prefix"

# The prefix is moved: an installed tree holds no path of its own.
mv "$prefix" "$work/moved"
prefix=$work/moved
if grep -rlF "$work/prefix" "$prefix/$libdir/cmake" "$prefix/$libdir/pkgconfig"; then
  echo "the files above name the folder they were installed to"
  exit 1
fi

echo "--- find_package"
"$cmake" -G Ninja -S "$source_dir/project" -B "$work/build" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix"
"$cmake" --build "$work/build"
"$work/build/consumer"

echo "--- pkg-config"
export PKG_CONFIG_PATH=$prefix/$libdir/pkgconfig
read -ra flags < <(pkg-config --cflags --libs hmlfc)
# The whole library is linked in, so that each library that hmlfc.pc leaves out is missed.
"$compiler" -std=c++20 "$source_dir/project/main.cpp" -o "$work/consumer" -L"$prefix/$libdir" \
  -Wl,--whole-archive -lhmlfc -Wl,--no-whole-archive "${flags[@]}" -Wl,-rpath,"$prefix/$libdir"
"$work/consumer"

echo "--- each header by itself"
for header in "$prefix"/include/hmlfc/*.hpp; do
  echo "#include <hmlfc/$(basename "$header")>" |
    "$compiler" -std=c++20 -Wall -Wextra -Werror -fsyntax-only -x c++ - "${flags[@]}"
done

if [[ -e $build_dir/tools/hmlfc ]]; then
  echo "--- binary"
  "$prefix/bin/hmlfc" --help
fi
