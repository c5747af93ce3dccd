// expect: 1104_not_constant.fx(2,15): error TG1104: 'root' is not a constant
float gUnit = root(2);
