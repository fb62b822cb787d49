# Included by the Makefile: the certificate's theorem, proven in Coq, and build/referee, the checker that the proof is about.
# Debian: coq libcoq-coquelicot libcoq-interval; for the referee also libcoq-core-ocaml-dev libzarith-ocaml-dev ocaml-findlib; and
# gappa; frama-c-base why3 cvc4.
COQC = coqc -q -noglob -w -all -R build/formal Svcd
FORMAL = Statement Answers Geometry Bezier Chains Inside Solid Ray_law Winding Box Checker Meeting Closed Rays Main Scenes

# Each file needs the one before it.
build/formal/%.vo: formal/%.v
	@mkdir -p $(@D)
	$(COQC) -o $@ $<
build/formal/Answers.vo: build/formal/Statement.vo
build/formal/Geometry.vo: build/formal/Answers.vo
build/formal/Chains.vo build/formal/Inside.vo: build/formal/Geometry.vo
build/formal/Chains.vo: build/formal/Bezier.vo
build/formal/Solid.vo build/formal/Checker.vo: build/formal/Inside.vo
build/formal/Ray_law.vo: build/formal/Solid.vo
build/formal/Winding.vo: build/formal/Ray_law.vo
build/formal/Meeting.vo: build/formal/Checker.vo
build/formal/Box.vo: build/formal/Winding.vo
build/formal/Closed.vo: build/formal/Meeting.vo build/formal/Winding.vo
build/formal/Rays.vo: build/formal/Closed.vo
build/formal/Main.vo: build/formal/Rays.vo
build/formal/Scenes.vo: build/formal/Main.vo

build/formal/checker.ml: formal/Extract.v build/formal/Main.vo
	@cd build/formal && coqc -q -noglob -w -all -R . Svcd -o Extract.vo ../../formal/Extract.v
	rm -f build/formal/checker.mli
# Extracted text that OCaml does not take as it is: an axiom of the reals, which nothing calls, must not fail as the program
# starts; and two types of the kernel's doubles must be known by their constructors.
build/referee: build/formal/checker.ml formal/referee.ml
	sed -i 's/failwith "AXIOM TO BE REALIZED"/(fun _ -> failwith "an axiom is called")/' build/formal/checker.ml
	{ echo 'type comparison_ = Float64.float_comparison = FEq | FLt | FGt | FNotComparable'; \
	  echo 'type class_ = Float64.float_class = PNormal | NNormal | PSubn | NSubn | PZero | NZero | PInf | NInf | NaN'; \
	  cat build/formal/checker.ml; } >build/formal/extracted.ml
	cp formal/referee.ml build/formal/
	cd build/formal && ocamlfind ocamlopt -O3 -rectypes -thread -package zarith,coq-core.kernel -linkpkg -w -a \
	  extracted.ml referee.ml -o ../referee

.PHONY: formal formal-proofs
formal-proofs: $(FORMAL:%=build/formal/%.vo)
formal: | build  ## proves the certificate's theorem (Coq), compares build/referee with build/verify; bounds of roundings; no runtime error
	@formal/check.sh && formal/margins.sh && formal/wp.sh
