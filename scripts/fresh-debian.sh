# SPDX-License-Identifier: BSD-3-Clause
# Sourced by scripts that try something in a freshly made, minimal Debian. Needs root, debootstrap and
# a Debian mirror. The script's own arguments are to be in "$@" when it is sourced.

fail() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}
[[ $(id -u) -eq 0 ]] || fail "must be root"
command -v debootstrap > /dev/null || fail "please install debootstrap"

# Mounts and processes live in namespaces of their own, so that none outlives the script, however it
# ends.
if [[ -z ${ODE_EXT_IN_NAMESPACE:-} ]]; then
  export ODE_EXT_IN_NAMESPACE=yes
  exec unshare --mount --propagation private --pid --fork --kill-child "$0" "$@"
fi

if [[ -z ${MIRROR:-} ]]; then
  MIRROR=$(apt-get indextargets --format '$(REPO_URI)' "Codename: bookworm" "Created-By: Packages" |
    head -n 1)
  [[ -n $MIRROR ]] || fail "found no mirror of Debian in apt's sources; please set MIRROR"
fi

chroot=
remove_chroot() {
  [[ -n $chroot ]] || return 0
  umount -R "$chroot/proc" "$chroot/sys" "$chroot/dev" 2> /dev/null || true
  if [[ -n ${keep:-} ]]; then
    echo "The chroot is $chroot"
  else
    rm -rf --one-file-system "$chroot"
  fi
  chroot=
}
trap remove_chroot EXIT

# make_chroot <suite>: sets $chroot; it is gone when the script ends, unless $keep is set.
make_chroot() {
  chroot=$(mktemp -d --tmpdir ode_ext-chroot.XXXXXX)
  echo "Making a minimal $1"
  debootstrap --variant=minbase "$1" "$chroot" "$MIRROR" > "$chroot.log" 2>&1 ||
    { tail -n 20 "$chroot.log" >&2; rm -f "$chroot.log"; fail "debootstrap failed"; }
  rm -f "$chroot.log"
  # How this machine reaches its mirror; its sources and other settings stay out.
  apt-config dump | grep -E '^Acquire::((http|https|ftp)::(Proxy|Verify|CaInfo)|Check-)' \
    > "$chroot/etc/apt/apt.conf.d/99host" || true
  cp -L /etc/resolv.conf "$chroot/etc/resolv.conf"
  mount -t proc proc "$chroot/proc"
  mount --rbind /sys "$chroot/sys"
  mount --rbind /dev "$chroot/dev"
}

# inside <command>...: in the chroot, with an environment that says nothing of this machine.
inside() {
  env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
    ${POCL_MEMORY_LIMIT:+POCL_MEMORY_LIMIT="$POCL_MEMORY_LIMIT"} chroot "$chroot" "$@"
}

# inside_apt <argument>...: apt-get, whose output is shown where it fails.
inside_apt() {
  inside env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@" > "$chroot/tmp/apt.log" 2>&1 ||
    { tail -n 20 "$chroot/tmp/apt.log" >&2; return 1; }
}
