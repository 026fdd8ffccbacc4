#!/bin/sh
# Builds the site as scripts/site.sh does and looks for dead links. Where Doxygen was not found when the
# build was configured, its pages are left out and links to them do not count.
# site_test.sh REPOSITORY BUILD OUTPUT
set -eu
repository=$1 build=$2 site=$3
python=/usr/bin/python3
for package in mkdocs mkdocs-material libjs-katex; do
  dpkg-query -W "$package" >/dev/null 2>&1 || { echo "skipped: $package is missing"; exit 77; }
done
"$repository/scripts/site/build.sh" "$build/flbc" "$site"
if [ -f "$build/docs/Doxyfile" ] && command -v doxygen >/dev/null; then
  doxygen "$build/docs/Doxyfile" >"$site/../doxygen.log" 2>&1
  cp -r "$build/docs/html" "$site/api"
else
  mkdir -p "$site/api"
  echo '<html><body>not made</body></html>' >"$site/api/index.html"
fi
$python -B "$repository/scripts/site/check_links.py" "$site"
# The checker sees a dead link and a dead anchor.
cp -r "$site" "$site.broken"
trap 'rm -rf "$site.broken"' EXIT
for link in absent.html 'index.html#absent'; do
  echo "<a href=\"$link\">x</a>" >"$site.broken/broken.html"
  if $python -B "$repository/scripts/site/check_links.py" "$site.broken" >/dev/null; then
    echo "a link to $link was not noticed" >&2
    exit 1
  fi
done
