using System.Linq;
using Collektive.Unity;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>Tests that users can select programs in inspectors or drop them there, and that each parameter has a field of its type.</summary>
    [Category("Mono"), Category("AnyPlacement")]
    public sealed class ProgramDrawerTests : ProjectFixture
    {
        private SimulationManager manager;
        private ProgramLibrary library;
        private Node node;

        [SetUp]
        public void MakeScene()
        {
            Gui.Clear();
            library = Import("swarm", ProgramLibraryTests.Program("flock"), ProgramLibraryTests.Program(
                "hops", "steps\t3\tNumber of steps.", "range\t2.0\t", "far\tfalse\t", "title\tnone\t", "shape\tRING\t\tRING\tLINE"));
            manager = new GameObject("Manager").AddComponent<SimulationManager>();
            manager.Settings.libraries.Add(library);
            manager.Settings.defaultProgram = library.Find("hops");
            node = new GameObject("Node").AddComponent<Node>();
        }

        [Test]
        public void A_picked_program_replaces_a_name()
        {
            manager.Settings.program = "hop";
            Inspect(manager);
            Assert.That(Gui.Lines, Has.Some.EqualTo("object defaultProgram: hops"));
            Assert.That(Gui.Lines, Has.Some.StringStarting("help Warning: Program 'hop' was set by name"));
            Gui.Act("defaultProgram", library.Find("flock"));
            Inspect(manager);
            Assert.That(manager.Settings.defaultProgram, Is.SameAs(library.Find("flock")));
            Assert.That(manager.Settings.program, Is.Empty);
            Project.PerformUndo();
            Assert.That((manager.Settings.defaultProgram.Name, manager.Settings.program), Is.EqualTo(("hops", "hop")));
        }

        [Test]
        public void A_dropped_library_with_one_program_selects_it()
        {
            var single = Import("single", ProgramLibraryTests.Program("only"));
            var property = new SerializedObject(node).FindProperty("ownProgram");
            Drag(EventType.DragUpdated, property, single);
            Assert.That(DragAndDrop.visualMode, Is.EqualTo(DragAndDropVisualMode.Link));
            Assert.That(node.OwnProgram == null, Is.True);
            Drag(EventType.DragPerform, property, single);
            Assert.That(node.OwnProgram, Is.SameAs(single.Find("only")));
        }

        [Test]
        public void A_dropped_library_with_several_programs_offers_them()
        {
            var nodes = new[] { node, new GameObject("Second").AddComponent<Node>() };
            Drag(EventType.DragPerform, new SerializedObject(nodes).FindProperty("ownProgram"), library);
            Assert.That(Menus.ContextItems, Is.EqualTo(new[] { "flock", "hops" }));
            Menus.PickContextItem("flock");
            Assert.That(nodes.Select(each => each.OwnProgram), Is.All.SameAs(library.Find("flock")));
        }

        [Test]
        public void A_users_script_can_have_a_program_too()
        {
            var script = ScriptableObject.CreateInstance<Mission>();
            Drag(EventType.DragPerform, new SerializedObject(script).FindProperty("goal"), Import("single", ProgramLibraryTests.Program("only")));
            Assert.That((script.goal.Name, script.program), Is.EqualTo(("only", "the user's text")));
        }

        [Test]
        public void Other_drops_are_left_to_the_field()
        {
            var property = new SerializedObject(node).FindProperty("ownProgram");
            Assert.That(Drag(EventType.DragPerform, property, node), Is.EqualTo(EventType.DragPerform));
            Assert.That(Drag(EventType.DragPerform, property, library, 500), Is.EqualTo(EventType.DragPerform), "a drop beside the field must have no effect");
            Assert.That(node.OwnProgram == null, Is.True);
        }

        [Test]
        public void Parameters_have_fields_of_their_types_with_their_defaults()
        {
            Inspect(node);
            Assert.That(Gui.Lines.Skip(1), Is.EqualTo(new[]
            {
                "object ownProgram: ", "label Parameters of hops", "int steps: 3", "double range: 2", "toggle far: False", "text title: none",
                "popup shape: RING",
            }));
        }

        [TestCase("steps", 5, "5", 3)]
        [TestCase("range", 0.1, "0.1", 2.0)]
        [TestCase("far", true, "true", false)]
        [TestCase("title", "x", "x", "none")]
        [TestCase("shape", 1, "LINE", 0)]
        public void A_value_is_stored_unless_it_is_the_default(string name, object value, string stored, object byDefault)
        {
            Act(name, value);
            Assert.That(node.Parameters, Is.EqualTo(new[] { new NodeParameter(name, stored) }));
            Act(name, byDefault);
            Assert.That(node.Parameters, Is.Empty);
            Project.PerformUndo();
            Assert.That(node.Parameters, Is.EqualTo(new[] { new NodeParameter(name, stored) }));
            Project.PerformUndo();
            Assert.That(node.Parameters, Is.Empty);
        }

        [Test]
        public void Several_nodes_are_edited_together_and_undone_together()
        {
            var second = new GameObject("Second").AddComponent<Node>();
            second.Parameters.Add(new NodeParameter("range", "9"));
            second.Parameters.Add(new NodeParameter("steps", "4"));
            Inspect(node, second);
            Assert.That(Gui.Lines, Has.Some.EqualTo("int steps: (mixed)").And.Some.EqualTo("double range: (mixed)").And.Some.EqualTo("toggle far: False"));
            Assert.That(second.Parameters, Has.Count.EqualTo(2), "drawing must not change the parameters");
            Act("steps", 7, node, second);
            Assert.That(node.Parameters, Is.EqualTo(new[] { new NodeParameter("steps", "7") }));
            Assert.That(second.Parameters, Is.EqualTo(new[] { new NodeParameter("range", "9"), new NodeParameter("steps", "7") }));
            Project.PerformUndo();
            Assert.That(node.Parameters, Is.Empty);
            Assert.That(second.Parameters[1].value, Is.EqualTo("4"));
        }

        [Test]
        public void Nodes_of_different_programs_have_no_common_parameters()
        {
            var second = new GameObject("Second").AddComponent<Node>();
            second.OwnProgram = library.Find("flock");
            Inspect(node, second);
            Assert.That(Gui.Lines, Has.None.Contains("Parameters of"));
            Assert.That(Gui.Lines, Has.Some.EqualTo("property parameters"));
        }

        [Test]
        public void A_value_of_another_type_is_text()
        {
            node.Parameters.Add(new NodeParameter("steps", "2.5"));
            Inspect(node);
            Assert.That(Gui.Lines, Has.Some.EqualTo("text steps: 2.5"));
            node.Parameters[0] = new NodeParameter("shape", "CUBE");
            Inspect(node);
            Assert.That(Gui.Lines, Has.Some.EqualTo("text shape: CUBE"));
        }

        [Test]
        public void A_value_without_a_parameter_is_an_error_and_can_be_removed()
        {
            node.Parameters.Add(new NodeParameter("stepps", "80"));
            Inspect(node);
            Assert.That(Gui.Lines, Has.Some.EqualTo("text stepps: 80"));
            Assert.That(Gui.Lines, Has.Some.EqualTo("help Error: Program 'hops' has no parameter 'stepps'. Clear the field to remove the value."));
            Act("stepps", "");
            Assert.That(node.Parameters, Is.Empty);
        }

        private sealed class Mission : ScriptableObject
        {
            public AggregateProgram goal = null;
            public string program = "the user's text";
        }

        private static ProgramLibrary Import(string name, params string[] programs)
        {
            ProgramLibraryTests.Pack("Assets/" + name + ".clkprograms", (name + ".ProgramsKt", string.Concat(programs)));
            return AssetDatabase.LoadAssetAtPath<ProgramLibrary>("Assets/" + name + ".clkprograms");
        }

        private static void Inspect(params Object[] targets)
        {
            var editor = UnityEditor.Editor.CreateEditor(targets);
            Gui.Clear();
            Gui.Passes(editor.OnInspectorGUI);
        }

        private void Act(string field, object value) => Act(field, value, node);

        private static void Act(string field, object value, params Object[] targets)
        {
            Gui.Act(field, value);
            Inspect(targets);
        }

        /// <summary>Sends a drag event to a property, and returns the type of the event afterwards.</summary>
        private static EventType Drag(EventType type, SerializedProperty property, Object dragged, float x = 10)
        {
            DragAndDrop.objectReferences = new[] { dragged };
            var drawer = Menus.DrawerOf(typeof(AggregateProgram));
            var drag = new Event { type = type, mousePosition = new Vector2(x, 5) };
            Gui.Passes(() => drawer.OnGUI(new Rect(0, 0, 300, 18), property, new GUIContent("Program")), null, drag);
            return drag.type;
        }
    }
}
