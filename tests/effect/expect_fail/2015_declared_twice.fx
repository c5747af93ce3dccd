// expect: 2015_declared_twice.fx(3,8): error TG2015: parameter 'gScale' is declared twice; the first is in line 2
float gScale = 1;
float3 gScale;
