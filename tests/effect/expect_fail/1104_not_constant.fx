// expect: 1104_not_constant.fx(2,15): error TG1104: 'sqrt' is not a constant
float gUnit = sqrt(2);
