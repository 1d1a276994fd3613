// Whether a cloth has faults.

namespace Texere
{
    /// <summary>The check of a cloth: its measures, its faults, and single changes of the design that cure them.</summary>
    public sealed unsafe class Check : Handle
    {
        /// <summary>Checks a cloth and its mesh. Null settings stand for those that suit its yarns.</summary>
        /// <param name="cloth">The cloth.</param>
        /// <param name="settings">The settings of the mesh.</param>
        /// <param name="accuracy">The share by which yarns may come short of touching without a fault.</param>
        /// <param name="run">Gets the progress, and can cancel the call.</param>
        public Check(
            Cloth cloth, Settings? settings = null, double accuracy = Native.TEXERE_ACCURACY, Run run = null)
            : base(Made(cloth, settings, accuracy, run)) { }

        static texere_check* Made(Cloth cloth, Settings? settings, double accuracy, Run run)
        {
            texere_check* made;
            var given = settings.GetValueOrDefault().Native;
            var status = Native.texere_check_new(
                cloth.Own, settings.HasValue ? &given : null, accuracy, Run.Of(run), &made);
            Call.Check(status, cloth, run);
            return made;
        }

        texere_check* Own => (texere_check*)Pointer;

        texere_diagnosis Diagnosis
        {
            get
            {
                var diagnosis = new texere_diagnosis { struct_size = (uint)sizeof(texere_diagnosis) };
                Call.Check(Native.texere_check_diagnosis(Own, &diagnosis), this);
                return diagnosis;
            }
        }

        /// <summary>Whether there is no fault.</summary>
        public bool IsClean => Diagnosis.clean != 0;

        /// <summary>"clean", or the faults in one phrase, such as "pierces itself, folds".</summary>
        public override string ToString() => Copied(Diagnosis.words);

        /// <summary>The faults and their cures as JSON, as the command texere check --json prints them.</summary>
        public string Json
        {
            get
            {
                byte* json;
                Call.Check(Native.texere_check_json(Own, &json), this);
                return Copied(json);
            }
        }

        /// <summary>Counts and measures of the cloth as JSON, as the command texere inspect --json prints them.</summary>
        public string MeasuresJson
        {
            get
            {
                byte* json;
                Call.Check(Native.texere_check_measures_json(Own, &json), this);
                return Copied(json);
            }
        }

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_check_free((texere_check*)handle);
            return true;
        }
    }
}
