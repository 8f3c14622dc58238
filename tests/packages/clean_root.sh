#!/usr/bin/env bash
# Installs the packages of ./packages.sh into a fresh Debian 12 without compilers and uses them there.
# usage: tests/packages/clean_root.sh [PACKAGES [ROOT]]   as root; needs debootstrap and the network.
#   PACKAGES: directory of the .deb files, default build/release/packages; ROOT: kept if given, and used again.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
packages="$(realpath "${1:-$here/build/release/packages}")"
root="${2:-}"
if [ -z "$root" ]; then
  root="$(mktemp -d)"
  trap 'leave; rm -rf --one-file-system "$root"' EXIT
else
  trap leave EXIT
fi
leave() { if mountpoint -q "$root/proc"; then umount "$root/proc"; fi; }
[ -x "$root/bin/sh" ] || debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian >/dev/null
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc" # the program looks there where it lies
in_root() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/srv LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }

rm -rf "$root/packages"
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages"
cp /etc/resolv.conf "$root/etc/resolv.conf"

echo "== the program alone"
in_root sh -c 'apt-get update -qq && apt-get install -y -qq --no-install-recommends /packages/buckens_*.deb' >/dev/null
if in_root sh -c 'command -v g++ cc cmake python3'; then echo "error: the root is not clean"; exit 1; fi
in_root buckens version
in_root buckens run /usr/share/buckens/examples/slider_crank/slider_crank.yaml -o /srv/crank --quiet
in_root buckens view /srv/crank
test "$(stat -c %s "$root/srv/crank/view.html")" -gt 500000
test -s "$root/usr/share/man/man1/buckens.1.gz" -o ! -d "$root/usr/share/man/man1" # minbase may leave manuals out

echo "== the Python module"
in_root sh -c 'apt-get install -y -qq --no-install-recommends /packages/python3-buckens_*.deb python3-h5py' >/dev/null
in_root python3 -c '
import buckens
model = buckens.load("/usr/share/buckens/examples/pendulum/pendulum.yaml", set={"simulation.duration": "10 ms"})
sim = buckens.Simulation(model, out="/srv/pendulum")
print(sim.run()["steps"], "steps;", len(buckens.open("/srv/pendulum").time), "records;", buckens.check(model)["title"])'

for file in "$root"/packages/buckens-doc_*.deb; do
  [ -f "$file" ] || break
  echo "== the documentation"
  in_root sh -c 'apt-get install -y -qq --no-install-recommends /packages/buckens-doc_*.deb' >/dev/null
  test -s "$root/usr/share/doc/buckens-doc/html/index.html"
done

echo "== the library, with the compiler that belongs to it"
in_root sh -c 'apt-get install -y -qq --no-install-recommends /packages/libbuckens-dev_*.deb g++ cmake ninja-build' >/dev/null
rm -rf "$root/srv/cpp" "$root/srv/cpp-build"
cp -r "$root/usr/share/buckens/examples/cpp" "$root/srv/cpp"
in_root cmake -S /srv/cpp -B /srv/cpp-build -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
in_root cmake --build /srv/cpp-build >/dev/null
in_root /srv/cpp-build/pendulum

echo "== and away again"
in_root sh -c 'apt-get purge -y -qq buckens libbuckens-dev python3-buckens "buckens-doc*" python3-h5py g++ cmake ninja-build &&
  apt-get autoremove -y -qq --purge' >/dev/null
if [ -e "$root/usr/share/buckens" ] || [ -e "$root/usr/bin/buckens" ] || [ -e "$root/usr/lib/python3/dist-packages/buckens" ]; then echo "error: files are left"; exit 1; fi
echo "packages: ok"
