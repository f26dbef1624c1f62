# bash completion of skyig and skyigd. Verbs, options and the words that an option takes are asked of the programs'
# own --help, so that they are those of the version at hand.

# What an option takes, as --help has it behind the option's name: "{a,b}", "FILE", "INT in ..."; nothing for a flag.
_skyig_takes() {
    local help=$1 option=$2
    awk -v option="$option" '
        /^ +-/ {
            names = $1
            split(names, name, ",")
            for (i in name) if (name[i] == option) {
                text = length($0) > 30 && substr($0, 30, 1) == " " && $0 !~ /\{/ ? substr($0, 1, 30) : $0
                sub(/^ +[^ ]+/, "", text)
                sub(/^ +/, "", text)
                sub(/ .*/, "", text)
                sub(/^[A-Z]+:\{/, "{", text)
                print text
                exit
            }
        }' <<<"$help"
}

_skyig() {
    local program=$1 current=$2 previous=$3 verb= help takes
    COMPREPLY=()
    if [[ ${program##*/} == skyig ]]; then
        if ((COMP_CWORD == 1)); then
            help=$("$program" --help 2>/dev/null)
            mapfile -t COMPREPLY < <(compgen -W "--help --version $(sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p' <<<"$help")" -- "$current")
            return
        fi
        verb=${COMP_WORDS[1]}
        [[ $verb =~ ^[a-z]+$ ]] || return
    fi
    help=$("$program" ${verb:+"$verb"} --help 2>/dev/null)
    if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(grep -oE '^ +-[^ ]+' <<<"$help" | tr ',' ' ')" -- "$current")
        return
    fi
    takes=
    [[ $previous == -* ]] && takes=$(_skyig_takes "$help" "$previous")
    case $takes in
        '{'*) mapfile -t COMPREPLY < <(compgen -W "$(tr -d '{}' <<<"$takes" | tr ',' ' ')" -- "$current") ;;
        DIR*) mapfile -t COMPREPLY < <(compgen -d -- "$current"); compopt -o filenames 2>/dev/null ;;
        '' | *FILE* | PRESET*) mapfile -t COMPREPLY < <(compgen -f -- "$current"); compopt -o filenames 2>/dev/null ;;
    esac
}
complete -F _skyig skyig skyigd
