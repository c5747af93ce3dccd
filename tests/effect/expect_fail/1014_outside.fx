// expect: 1014_outside.fx(2,10): error TG1014: /etc/passwd lies outside of the effect's folder and its project; if it may be read: -I /etc, or --anywhere
#include "/etc/passwd"
