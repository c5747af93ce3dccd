// expect: 1006_bad_condition.fx(2,2): error TG1006: #if: a value is missing
#if 3 +
#endif
