#!/bin/sh
# Part of make-release, run in its root without a network: builds the sources in /src in /build, and packs them and the
# playground in /page in /build/out. $1 is the version.
set -eu
version=$1
umask 022
cd /build

# Configures build folder $1; the other words are options for cmake.
configure() {
  arch=$1
  shift
  cmake -S /src -B "$arch" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPIPELINE_TESTS=OFF -DPIPELINE_ALL_KERNELS=ON -DPIPELINE_STATIC_TOOLS=ON -DPIPELINE_STATIC_TOOLS_RUN=ON \
    -DPIPELINE_STATIC_PNG="/usr/lib/$arch-linux-gnu/libpng.a" -DPIPELINE_STATIC_ZLIB="/usr/lib/$arch-linux-gnu/libz.a" "$@"
}

# Packs the folder pack/$1. Whoever unpacks it owns it; time and user of packing leave no trace.
pack() {
  tar -C pack --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --mode=u+rwX,go=rX --format=gnu -cf "$1.tar" "$1"
  xz -9e -T1 < "$1.tar" > "out/$1.tar.xz"
}

# Puts the program of the build folder $1, stripped by $2, into the folder $3.
put_program() {
  $2 -o "$3/libexec/pipeline/tools/all-tools" "$1/bin/all-tools"
}

rm -rf pack out installed deb
mkdir pack out
cp /page/playground.html "out/pipeline-$version-playground.html"
cp -a /page/playground "pack/pipeline-$version-playground"
configure x86_64
cmake --build x86_64
configure aarch64 -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++
cmake --build aarch64 --target all-tools
sh /src/scripts/package/build_windows.sh windows

cmake --install x86_64 --prefix /build/installed
[ -s installed/share/doc/pipeline/THIRD-PARTY ]  # else cmake has named the parts without a license
put_program x86_64 strip installed
(cd x86_64 && cpack -D CPACK_INSTALL_CMAKE_PROJECTS= -D "CPACK_INSTALLED_DIRECTORIES=/build/installed;/usr" \
  -D CPACK_DEBIAN_COMPRESSION_TYPE=xz -B /build/deb)
cp deb/*.deb windows/*.zip out/
# The archives have no library.
rm -r installed/include installed/lib
for arch in x86_64 aarch64; do cp -a installed "pack/pipeline-$version-linux-$arch"; done
put_program aarch64 aarch64-linux-gnu-strip "pack/pipeline-$version-linux-aarch64"
cp -a installed/share/pipeline/conformance "pack/pipeline-$version-conformance"
cp /src/LICENSE "pack/pipeline-$version-conformance"
cp -a /src "pack/pipeline-$version-source"
for folder in pack/*; do pack "${folder#pack/}"; done
dpkg-query -W > out/built-with.txt
