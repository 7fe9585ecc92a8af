#!/bin/sh
# embed.sh PREFIX FILE... - texts for a program, as C on stdout: NAME.KIND.glsl and
# NAME.KIND.in become the array PREFIXNAME_KIND, NAME.py becomes PREFIXNAME.
set -eu
prefix=$1
shift
for file; do
  name=$(basename "${file%.*}" | tr . _)
  echo "const char $prefix${name}[] ="
  sed 's/[\\"]/\\&/g; s/.*/"&\\n"/' "$file"
  echo ';'
done
