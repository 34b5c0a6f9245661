# A Debian 12 in a folder, made of Debian's packages alone. Sourced by packaging/test and packaging/container, not run.
# shellcheck shell=bash

# debian_in FOLDER LOG: makes it, with nothing in it but what every Debian has.
debian_in() {
    local folder=$1 log=$2 mirror
    # shellcheck disable=SC2016  # apt-get's own fields
    mirror=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' 2>/dev/null |
        awk '$2 == "bookworm" && !found {print $1; found = 1}')
    debootstrap --variant=minbase bookworm "$folder" "${mirror:-http://deb.debian.org/debian}" >"$log" 2>&1 || {
        tail -n 20 "$log" >&2
        printf '%s\n' "packaging: debootstrap could not make a Debian in $folder; the whole log is $log" >&2
        return 1
    }
}

# inside FOLDER COMMAND...: runs it there as root; as USER where that is set, in the user's home.
inside() {
    local folder=$1 user=${USER_INSIDE:-root} home=/root
    shift
    [ "$user" = root ] || home=/home/$user
    chroot --userspec="$user" "$folder" /usr/bin/env -i --chdir="$home" HOME="$home" LC_ALL=C.UTF-8 \
        PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"
}

# enter FOLDER: what programs in there look for: /proc, and the names of the network.
enter() {
    mountpoint -q "$1/proc" || mount -t proc proc "$1/proc"
    cp /etc/resolv.conf "$1/etc/resolv.conf"
}

# leave FOLDER: nothing of this computer is left in it.
leave() {
    ! mountpoint -q "$1/proc" || umount "$1/proc"
}
