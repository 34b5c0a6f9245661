# Debian 12 in a folder, made only of Debian's packages. Sourced by packaging/test and packaging/container, not run.
# shellcheck shell=bash

# debian_in FOLDER LOG: makes a minimal Debian in the folder.
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

# inside FOLDER COMMAND...: runs the command there as root, or as the user in USER_INSIDE, in the user's home.
inside() {
    local folder=$1 user=${USER_INSIDE:-root} home=/root
    shift
    [ "$user" = root ] || home=/home/$user
    chroot --userspec="$user" "$folder" /usr/bin/env -i --chdir="$home" HOME="$home" LC_ALL=C.UTF-8 \
        PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"
}

# enter FOLDER: mounts /proc and copies resolv.conf, which programs in the folder need.
enter() {
    mountpoint -q "$1/proc" || mount -t proc proc "$1/proc"
    cp /etc/resolv.conf "$1/etc/resolv.conf"
}

# leave FOLDER: unmounts /proc.
leave() {
    ! mountpoint -q "$1/proc" || umount "$1/proc"
}
