#!/bin/sh
# Builds the four filters and trace for Windows in the folder $1, with mingw-w64, and packs them as
# $1/pipeline-VERSION-windows-x86_64.zip. SOURCE_DATE_EPOCH is the date of the files in it.
set -eu
umask 022
build=$(mkdir -p "$1" && cd "$1" && pwd -P)
CDPATH='' cd -- "$(dirname -- "$(readlink -f -- "$0")")/../.."

# Headers in a folder of their own: in /usr/include, mingw-w64 would find this system's C library beside them.
mkdir -p "$build/include" "$build/share/cmake"
ln -sfn /usr/include/hwy /usr/include/CLI "$build/include"
ln -sfn /usr/share/cmake/CLI11 "$build/share/cmake"
cmake -S . -B "$build" -G Ninja -DPIPELINE_TESTS=OFF -DPIPELINE_PNG=OFF -DPIPELINE_PARTS=OFF -DPIPELINE_MODELS=OFF -DPIPELINE_INSTALL=OFF \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=x86_64 -DCMAKE_CXX_COMPILER=x86_64-w64-mingw32-g++-posix \
  -DCMAKE_CXX_FLAGS=-Werror -DHIGHWAY_INCLUDE_DIR="$build/include" -DCLI11_DIR="$build/share/cmake/CLI11"
cmake --build "$build" --target model view project zbuf trace --parallel "${jobs-$(nproc)}"

name=pipeline-$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")-windows-x86_64
rm -rf "${build:?}/$name"*
mkdir "$build/$name"
for tool in model view project zbuf trace; do x86_64-w64-mingw32-strip -o "$build/$name/$tool.exe" "$build/bin/$tool.exe"; done
cp -R LICENSE samples/materials samples/worked-example "$build/$name"
scripts/package/third-party "$build" > "$build/$name/THIRD-PARTY"
find "$build/$name" -exec touch -d "@${SOURCE_DATE_EPOCH-946684800}" {} +
(cd "$build" && TZ=UTC python3 -m zipfile -c "$name.zip" "$name")
