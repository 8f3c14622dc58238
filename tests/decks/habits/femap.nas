INIT MASTER(S)
NASTRAN SYSTEM(442)=-1,SYSTEM(319)=1
ID Model 1,Femap
SOL SEMODES
TIME 10000
CEND
  TITLE = Simcenter Nastran Modal Analysis Set
  ECHO = NONE
  DISPLACEMENT(PLOT) = ALL
  METHOD = 1
  SPC = 1
$ *************************************************
$ PROBABLY SHOULD NOT CHANGE ANYTHING BELOW
$ *************************************************
BEGIN BULK
$ ***************************************************************************
$   Written by : Femap
$   Version    : 2022.1.0
$   Translator : Simcenter Nastran
$   From Model : C:\Users\x\model.modfem
$ ***************************************************************************
$
PARAM,PRGPST,NO
PARAM,POST,-1
PARAM,OGEOM,NO
PARAM,AUTOSPC,YES
PARAM,GRDPNT,0
EIGRL          1                      10       0                    MASS
CORD2C         1       0      0.      0.      0.      0.      0.      1.+FEMAPC1
+FEMAPC1      1.      0.      1.
CORD2S         2       0      0.      0.      0.      0.      0.      1.+FEMAPC2
+FEMAPC2      1.      0.      1.
$ Femap Constraint Set 1 : Untitled
SPC1           1  123456      21
$ Femap Property 1 : Solid
PSOLID         1       1       0        
$ Femap Property 2 : Lumped mass
$ Femap Property 3 : Bush
PBUSH          3       K 200000. 200000. 200000.1.E+8   1.E+8   1.E+8   +       
+              B                                                        +       
+            GE                                                         
$ Femap Material 1 : Steel
MAT1           1 210000.              .3 7.85E-9      0.      0.        +       
+         210.    210.
MAT4           1      0.              7.85E-9
GRID           1       0      0.      0.      0.       0
GRID           2       0     25.      0.      0.       0
GRID           3       0     50.      0.      0.       0
GRID           4       0     75.      0.      0.       0
GRID           5       0    100.      0.      0.       0
GRID           6       0      0.     20.      0.       0
GRID           7       0     25.     20.      0.       0
GRID           8       0     50.     20.      0.       0
GRID           9       0     75.     20.      0.       0
GRID          10       0    100.     20.      0.       0
GRID          11       0      0.      0.     10.       0
GRID          12       0     25.      0.     10.       0
GRID          13       0     50.      0.     10.       0
GRID          14       0     75.      0.     10.       0
GRID          15       0    100.      0.     10.       0
GRID          16       0      0.     20.     10.       0
GRID          17       0     25.     20.     10.       0
GRID          18       0     50.     20.     10.       0
GRID          19       0     75.     20.     10.       0
GRID          20       0    100.     20.     10.       0
GRID          21       0    120.     10.      5.       0        
GRID          22       0    130.     10.      5.       0        
CHEXA          1       1       1       2       7       6      11      12+       
+             17      16
CHEXA          2       1       2       3       8       7      12      13+       
+             18      17
CHEXA          3       1       3       4       9       8      13      14+       
+             19      18
CHEXA          4       1       4       5      10       9      14      15+       
+             20      19
RBE3          50              21  123456     1.0     123       5      10+       
+             15      20
CONM2         51      22       0   0.002      2.      0.      0.        +       
+             1.      0.      1.      0.      0.      1.
CBUSH         52       3      21      22                               0
ENDDATA 1a2b3c4d
