#!/usr/bin/env bash
# Uses wrapatlas as other projects do: by find_package, by pkg-config and by add_subdirectory.
# usage: run.sh SOURCE BUILD [cmake arguments]; BUILD is a finished build, which is installed.
set -euo pipefail
source=$1
build=$2
shift 2

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
consumer=$source/tests/consumer

echo "== install, and move what was installed"
cmake --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix"
"$work/prefix/bin/wrapatlas" --version

echo "== find_package"
cmake -S "$consumer" -B "$work/package" -G Ninja "$@" -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/package"
"$work/package/consumer"

echo "== pkg-config and g++"
pc=("$work"/prefix/lib*/pkgconfig "$work"/prefix/lib/*/pkgconfig)
PKG_CONFIG_PATH=$(IFS=: && echo "${pc[*]}")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046  # the flags are words
g++ -std=c++20 "$consumer/main.cpp" -o "$work/consumer" $(pkg-config --cflags --libs wrapatlas)
LD_LIBRARY_PATH=$(pkg-config --variable=libdir wrapatlas) "$work/consumer"

echo "== add_subdirectory"
cmake -S "$consumer" -B "$work/sub" -G Ninja "$@" -DWRAPATLAS_SOURCE="$source" -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS_DEBUG=-g0 -DCMAKE_UNITY_BUILD=ON >/dev/null  # nobody debugs it; it builds sooner
cmake --build "$work/sub"
"$work/sub/consumer"
