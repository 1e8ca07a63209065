# shellcheck shell=bash
# The commands whose writing test_faults.sh lets fail, each as small as it can be; sourced by it. Of each case:
#   words      its command line
#   earlier    what is there before it: files of the word "earlier", or a command line
#   varying    a pattern of the files that hold times: they are held against their format, the others against the bytes
#              of a run without faults
#   lost       a pattern of records that may be gone or emptied afterwards: none must outlive what it tells of
#   extra      a pattern of files that may be left in addition, for the next run of the same command
#   with_fakes whether other programs are the test's own
# shellcheck disable=SC2034 # used by test_faults.sh
declare -A words earlier varying lost extra with_fakes
cases=()

fault_case() { # name words...
    cases+=("$1")
    words[$1]="${*:2}"
}

fault_case render render wheel --size 8x8 -N 1 --quiet -o a.exr -o a.png -o a.tif -o a.jpg --aov steps,evals --stats s.json
earlier[render]='a.exr a.png a.tif a.jpg a.steps.png s.json'
varying[render]='s.json'

fault_case passes render planet --size 8x8 -N 1 --passes 2 --quiet -o a.exr -o a.png
earlier[passes]='a.exr'

# Three strips of rows, each written when it is rendered.
fault_case streamed render wheel --size 16x160 -N 1 --quiet -o a.exr
earlier[streamed]='a.exr'
fault_case tiled render wheel --size 16x160 -N 1 --quiet --tiled -o a.exr -o b.png
earlier[tiled]='b.png'

fault_case frames animate planet --size 8x8 -N 1 --frames 0-1 --quiet --overwrite -o a.exr -o a.png
earlier[frames]='a.0000.exr a.0001.png'

# ffmpeg is fake here: it copies the frames, one behind the other.
fault_case film animate wheel --size 8x8 -N 1 --frames 0-1 --quiet -o a.webm -o a.mp4
earlier[film]='a.mp4'
extra[film]='a.webm.frames/frame.000?.png'
with_fakes[film]=yes

fault_case sweep sweep wheel --size 8x8 --N 1,2 --m 1 --quiet -o s
earlier[sweep]='sweep wheel --size 8x8 --N 1,3 --m 1 --quiet -o s'
varying[sweep]='s/sweep.@(csv|json)'

fault_case strip strip --scene wheel --size 8x8 --columns none,N=2 --parts --reference 1 --difference --quiet -o s.png
words[strip]=${words[strip]/,/;}
earlier[strip]='s.png s-1.exr'

fault_case plots figures --only 3 --size small --html --no-films --quiet -o f
earlier[plots]='f/figure-3.png f/figure-3-samples.csv f/index.html f/figure-3.json'
lost[plots]='f/figure-3.json'
fault_case sheets figures --only 6 --size small --quiet -o f
earlier[sheets]='f/figure-6.png f/figure-6.json'
lost[sheets]='f/figure-6.json'

fault_case converge converge edge --size 8x8 --N 1,2 --m 1 --estimators stratified --seeds 2 --repeats 1 --quiet -o c
earlier[converge]='c/converge.csv c/error-time.png c/error-samples.svg'
varying[converge]='c/@(converge.*|summary.md|error-time.*)'

fault_case stability stability --fast --only sums --quiet -o c --json r.json
earlier[stability]='c/stability.md r.json'

fault_case explain explain wheel --size 8x8 --quiet --json e.json
earlier[explain]='e.json'
varying[explain]='e.json'

fault_case bench bench --quick --rays 1000 --only octaves --quiet -o b
earlier[bench]='b/bench.json b/bench.svg'
varying[bench]='b/bench.*'

# Nothing but text, to standard output.
fault_case scenes scenes planet
fault_case probe probe samples wheel --size 8x8 -N 1 --pixel 0,0
