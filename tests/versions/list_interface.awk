# Enumerators and fields of public headers: "enum Denoiser REFERENCE", "field CommonSettings frameIndex".
{ sub(/\/\/.*/, "") }
/^enum class/ { kind = "enum"; owner = $3 == "[[nodiscard]]" ? $4 : $3; sub(/:.*/, "", owner); next }
/^struct [A-Za-z]+$/ { kind = "field"; owner = $2; next }
/^}/ { kind = ""; next }
kind == "enum" && match($0, /[A-Z][A-Z0-9_]+/) {
    while (match($0, /[A-Z][A-Z0-9_]+/)) {
        name = substr($0, RSTART, RLENGTH); $0 = substr($0, RSTART + RLENGTH)
        if (name != "MAX_NUM") print "enum", owner, name
    }
}
kind == "field" && !/\(/ && /;/ {
    sub(/ *(=.*)?;.*/, ""); sub(/\[[^\]]*\].*/, "")
    n = split($0, words, /[ ,*&]+/)
    if (/,/) { for (i = 3; i <= n; i++) if (words[i] ~ /^[a-zA-Z]/) print "field", owner, words[i] }
    else print "field", owner, words[n]
}
